/** Says that this is a shared result, when and by what it was computed, and the two ways on. */

import { Button, Group, Text, CloseButton } from "@mantine/core";
import { useMutation } from "@tanstack/react-query";
import type { ReactNode } from "react";
import { Icon } from "../../ui/icons";
import { api } from "../../api/client";
import type { Link, Run, Strategy, StrategyId, Summary } from "../../api/types";
import { useAction, useActionButton } from "../../lab/actions";
import { useLabContext, useLab } from "../../lab/context";
import { useSelector } from "@tanstack/react-store";
import ui from "../../ui/ui.module.css";
import { Fault, Note } from "../../ui/Messages";
import { formatDay, formatNumber } from "../../units/format";
import { formatPercent } from "../tables/change";
import { StrategyName, NameWithUnit } from "../../ui/StrategyKey";
import { Card } from "../../ui/Card";
import { DataTable } from "../../ui/DataTable";
import { fullName, type Metric } from "../../server/metrics";
import { useCatalogues } from "../../server/useCatalogues";
import { figureNamed } from "../../lab/metricPath";

export function SharedBanner({ strategies }: { readonly strategies: readonly Strategy[] }) {
  const { labAddress } = useLabContext();
  const { slug } = useSelector(labAddress);
  const shared = useLab((state) => state.shared);
  const failed = useLab((state) => state.failure !== null && state.failure.kind !== "unreachable");
  if (shared?.run) return <Banner key={shared.slug} link={shared} run={shared.run} strategies={strategies} />;
  // Its place is kept while the link is being opened.
  return slug !== null && !failed ? (
    <div className={ui.banner} aria-busy aria-label="Opening the shared result" />
  ) : null;
}

interface BannerProps {
  readonly link: Link;
  readonly run: Run;
  readonly strategies: readonly Strategy[];
}

function Banner({ link, run, strategies }: BannerProps) {
  const { lab, labAddress } = useLabContext();
  // The link's pins stay with it: what is against one of them would be against something else in the copy.
  const openCopy = () => {
    if (link.view.reference) labAddress.setView({ reference: "baseline", differences: false });
    lab.openCopy();
  };
  useAction("copy", openCopy);
  const { label, ...button } = useActionButton("copy");
  const over = run.over && { roads: run.over.roads, baseline: run.over.baseline };
  const again = useMutation({
    mutationFn: () => api.createRun(link.scenario, Object.keys(run.strategies), undefined, over),
  });
  return (
    <>
      <SharedNote link={link} what="result">
        <Group gap="0.4rem" data-unprinted>
          <Button variant="filled" leftSection={<Icon name="Copy" size={15} />} {...button}>
            {label}
          </Button>
          <Button
            leftSection={<Icon name="Refresh" size={15} />}
            loading={again.isPending}
            onClick={() => again.mutate()}
          >
            Run again on this version
          </Button>
        </Group>
      </SharedNote>
      {again.isError && (
        <Fault size="md" m="0.5rem 0.2rem 0">
          It could not be run again: {again.error.message}
        </Fault>
      )}
      {again.data && <DifferencesCard strategies={strategies} then={run} now={again.data} onClose={again.reset} />}
    </>
  );
}

interface SharedNoteProps {
  readonly link: Link;
  readonly what: "result" | "sweep";
  readonly children?: ReactNode;
}

/** Says that this is shared, when it was computed and by what, and what can be done with it. */
export function SharedNote({ link, what, children }: SharedNoteProps) {
  return (
    <section className={ui.banner} aria-label="Shared result">
      <Icon name="Lock" size={17} stroke={1.7} />
      <Text flex="1 1 14rem">
        Shared {what}, computed on {formatDay(link.computed_at)} by core {link.core_version}. Read-only.
        {link.damaged_at !== null &&
          ` Something stored of it was found damaged on ${formatDay(link.damaged_at)} and computed again by that core: it may differ from what was shared.`}
        {link.core_version !== link.current_core_version && ` This server now runs core ${link.current_core_version}.`}
      </Text>
      {children}
    </section>
  );
}

interface Props {
  readonly then: Run;
  readonly now: Run;
  readonly strategies: readonly Strategy[];
  readonly onClose: () => void;
}

/** Enough digits to see a small change, no more than are worth reading. */
const DIGITS = 6;

function show(value: Figure): string {
  if (typeof value === "boolean") return value ? "yes" : "no";
  return value === null ? "–" : formatNumber(value, DIGITS);
}

function change({ then, now }: Difference): string {
  if (typeof then !== "number" || typeof now !== "number") return "–";
  const moved = now - then;
  const size = `${moved > 0 ? "+" : ""}${formatNumber(moved)}`;
  if (then === 0) return size;
  const percent = (100 * moved) / Math.abs(then);
  return Math.abs(percent) < 0.05 ? size : `${size} (${formatPercent(percent)})`;
}

/** What this version computes otherwise than the one that made the shared result. */
function DifferencesCard({ then, now, strategies, onClose }: Props) {
  const { differences, compared, failed } = compareRuns(then, now, useCatalogues().figures);
  const same = then.core_version === now.core_version;
  return (
    <Card mt="0.6rem" aria-label="Differences">
      <Group
        component="header"
        gap="0.6rem"
        align="flex-start"
        justify="space-between"
        wrap="nowrap"
        p="0.6rem 0.6rem 0.6rem 0.9rem"
      >
        <div role="status">
          <Text component="h2" fw={650}>
            {differences.length === 0 ? "No differences" : `${differences.length} of ${compared} metrics differ`}
          </Text>
          <Note>
            {same
              ? `The same version, core ${now.core_version}, computed both: equal numbers are what to expect.`
              : `Core ${then.core_version} then, core ${now.core_version} now; ${compared} metrics compared, the largest change first.`}
          </Note>
        </div>
        <CloseButton size="sm" data-unprinted aria-label="Close the differences" onClick={onClose} />
      </Group>
      {failed.map((line) => (
        <Text key={line} px="0.9rem" pb="xs" c="var(--danger)">
          {line}
        </Text>
      ))}
      {differences.length > 0 && <DifferencesTable differences={differences} strategies={strategies} />}
    </Card>
  );
}

interface DifferencesTableProps {
  readonly differences: readonly Difference[];
  readonly strategies: readonly Strategy[];
}

function DifferencesTable({ differences, strategies }: DifferencesTableProps) {
  return (
    <DataTable
      label="Differences by metric"
      height="19rem"
      attributes={{ "data-dense": true }}
      rows={differences}
      rowKey={({ strategy, metric }) => `${strategy} ${metric}`}
      columns={[
        {
          key: "strategy",
          head: "Strategy",
          text: true,
          cell({ strategy: id }) {
            const strategy = strategies.find((each) => each.id === id);
            return strategy ? <StrategyName strategy={strategy} /> : id;
          },
        },
        {
          key: "metric",
          head: "Metric",
          text: true,
          cell: ({ metric, unit }) => <NameWithUnit name={metric} unit={unit} />,
        },
        { key: "then", head: "Then", cell: ({ then }) => show(then) },
        { key: "now", head: "Now", cell: ({ now }) => show(now) },
        { key: "change", head: "Change", cell: change },
      ]}
    />
  );
}

type Figure = number | boolean | null;

interface Difference {
  readonly strategy: StrategyId;
  readonly metric: string;
  readonly unit: string;
  readonly then: Figure;
  readonly now: Figure;
  /** Relative to the larger of both, 0 to 2; infinite where one of them is not a number. */
  readonly size: number;
}

interface Comparison {
  readonly differences: readonly Difference[];
  /** How many metrics were compared. */
  readonly compared: number;
  /** Strategies that failed then or now, in words. */
  readonly failed: readonly string[];
}

/** In the unit the page shows it in; `undefined` of a result that does not have it. */
function figureOf(summary: Summary, { key, scale }: Metric): Figure | undefined {
  const value = figureNamed(summary, key);
  return typeof value === "number" ? value * scale : value;
}

/** Room for rounding, as `ridelab compare` leaves it: a part of the value, and an amount in SI units. */
const [RELATIVE, ABSOLUTE] = [1e-6, 1e-9];

function sizeOf(then: Figure, now: Figure, scale: number): number {
  if (then === now) return 0;
  if (typeof then !== "number" || typeof now !== "number") return Infinity;
  if (Math.abs(now - then) <= Math.max(ABSOLUTE * scale, RELATIVE * Math.abs(then))) return 0;
  return Math.abs(now - then) / Math.max(Math.abs(then), Math.abs(now));
}

/** The same scenario computed twice: which metrics differ, the largest change first. */
export function compareRuns(then: Run, now: Run, metrics: readonly Metric[]): Comparison {
  const differences: Difference[] = [];
  const failed: string[] = [];
  let compared = 0;
  for (const [strategy, before] of Object.entries(then.strategies)) {
    const after = now.strategies[strategy];
    if (after === undefined) continue;
    if (before.status !== "ok" || after.status !== "ok") {
      const say = (entry: typeof before) => (entry.status === "ok" ? "computed" : `failed (${entry.reason})`);
      failed.push(`${strategy}: ${say(before)} then, ${say(after)} now`);
      continue;
    }
    for (const metric of metrics) {
      const [value, current = null] = [figureOf(before, metric), figureOf(after, metric)];
      if (value === undefined) continue;
      compared += 1;
      const size = sizeOf(value, current, metric.scale);
      if (size > 0)
        differences.push({ strategy, metric: fullName(metric), unit: metric.unit, then: value, now: current, size });
    }
  }
  return { differences: differences.sort((a, b) => b.size - a.size), compared, failed };
}
