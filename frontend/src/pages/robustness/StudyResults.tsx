/** What a study says: who keeps the lead, how far every figure spreads, what is stable, what it depends on. */

import { Text, Alert, Box, Progress } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useNavigate, useSearch } from "@tanstack/react-router";
import { useMemo } from "react";
import { isFinal } from "../../jobs/useJob";
import type { Catalogue, BatchSummary, Strategy, StrategyId } from "../../api/types";
import { paperMetrics } from "../../server/metrics";
import { formatWhole } from "../../units/format";
import { Limits, Spread } from "./Spread";
import { Matters, OneAtATime } from "./Matters";
import { AIRBORNE, summaryQuery, TRAVEL, quantile, type Margin, type StudyParts } from "./study";
import { useOpenRun } from "../../features/sweep/table";
import { Fault, Note } from "../../ui/Messages";
import ui from "../../ui/ui.module.css";
import { Icon } from "../../ui/icons";
import { formatPercent } from "../../features/tables/change";
import { StrategyName } from "../../ui/StrategyKey";
import { DataTable, type Column } from "../../ui/DataTable";
import { Choice, labelled } from "../../ui/Entry";
import { Card } from "../../ui/Card";
import { Loading } from "../../ui/Page";

/** Fewer finished points are no spread to look at. */
const LEAST_POINTS = 10;

interface Props extends Pick<StudyParts, "batch" | "figures" | "strategies"> {
  readonly catalogue: Catalogue;
}

export function StudyResults({ batch, figures, strategies, catalogue }: Props) {
  const { baseline = null, one } = useSearch({ from: "/robustness/$id" });
  const navigate = useNavigate({ from: "/robustness/$id" });
  const paper = useMemo(
    () => paperMetrics(catalogue).flatMap((key) => figures.find((figure) => figure.key === key) ?? []),
    [catalogue, figures],
  );
  const columns = useMemo(() => [...paper.map(({ key }) => key), TRAVEL, AIRBORNE], [paper]);
  const query = useQuery(summaryQuery(batch, columns, baseline));
  const opening = useOpenRun(batch);
  const summary = query.data;
  const ended = isFinal(batch);

  if (query.isError && !summary) {
    return <Fault size="md">The study could not be read: {query.error.message}</Fault>;
  }
  const finished = summary ? Math.min(...Object.values(summary.strategies).map(({ ok }) => ok)) : 0;
  if (!summary || (!ended && finished < LEAST_POINTS)) {
    if (ended && batch.done === 0 && batch.failed === 0)
      return <Text c="dimmed">No run has finished: there are no results.</Text>;
    return (
      <div className={ui.stack}>
        {!ended && (
          <Text c="dimmed">
            The first figures stand here as soon as {LEAST_POINTS} points have run under each strategy.
          </Text>
        )}
        <Loading label="Loading the study’s results" heights={[220, 420]} />
      </div>
    );
  }
  const shared = { summary, strategies, opening };
  return (
    <div
      className={ui.stack}
      data-testid="study-results"
      data-final={(ended && !query.isPlaceholderData) || undefined}
      aria-busy={query.isPlaceholderData}
    >
      {finished < summary.points && (
        <Text className={ui.warning} role="status">
          {ended && !query.isPlaceholderData ? "At" : "So far at"} least {formatWhole(finished)} of{" "}
          {formatWhole(summary.points)} points have run under each strategy; the figures below are of those.
        </Text>
      )}
      {opening.error !== null && <Fault size="md">This run could not be opened: {opening.error}</Fault>}
      <Unstable {...shared} />
      <Leads
        {...shared}
        figures={paper}
        onBaseline={(next) =>
          void navigate({
            to: ".",
            search: (before) => ({ ...before, baseline: next }),
            replace: true,
            resetScroll: false,
          })
        }
      />
      <Spread {...shared} figures={paper} />
      <Limits {...shared} />
      <Matters {...{ summary, strategies, batch }} figures={paper} />
      {one !== undefined && <OneAtATime id={one} {...{ strategies }} figures={paper} />}
      <Note>
        Percentiles lie between two values by distance. Every strategy runs at the same points; changes are taken point
        by point. The ranges are ours, not the paper’s: 5 and 95 % of these points say nothing about 5 and 95 % of real
        cars.
      </Note>
    </div>
  );
}

type UnstableProps = Pick<StudyParts, "summary" | "strategies">;

/** Says before everything else that some of what follows is an oscillation. */
function Unstable({ summary, strategies }: UnstableProps) {
  const sentences = strategies.flatMap(({ id, label }) => {
    const stability = summary.strategies[id]?.stability;
    return stability && stability.unstable > 0
      ? [`${label} is unstable at ${formatWhole(stability.unstable)} of ${formatWhole(stability.known)} points`]
      : [];
  });
  if (sentences.length === 0) return null;
  return (
    <Alert
      color="red"
      variant="light"
      icon={<Icon name="AlertTriangle" size={18} />}
      role="alert"
      data-testid="unstable"
    >
      {sentences.join("; ")}. There a small disturbance grows until the actuators’ limits stop it: the wheels then
      oscillate by themselves. The metrics below include those runs.
    </Alert>
  );
}

interface LeadsProps extends Pick<StudyParts, "summary" | "strategies" | "figures"> {
  readonly onBaseline: (baseline: StrategyId) => void;
}

/** At how many points the baseline strategy is better than each other one, and what is left of its lead. */
function Leads({ summary, strategies, figures, onBaseline }: LeadsProps) {
  const baseline = strategies.find(({ id }) => id === summary.baseline);
  const others = strategies.filter(({ id }) => id !== summary.baseline);
  if (!baseline || others.length === 0) return null;
  return (
    <Card
      aria-label="Who keeps the lead"
      title={`Where ${baseline.label} is better`}
      tools={<Choice aria-label="Baseline" value={summary.baseline} data={labelled(strategies)} onPick={onBaseline} />}
    >
      <Box component="ul" m={0} fz="sm" className={ui.note ?? ""} style={{ listStyle: "none" }} aria-label="Conclusion">
        {others.map(({ id, label }) => {
          const margins = figures.flatMap(({ key }) => summary.strategies[id]?.figures[key]?.margin ?? []);
          const leads = margins.flatMap(({ worse, better }) =>
            typeof worse === "number" && typeof better === "number" ? [{ worse, better }] : [],
          );
          return leads.length > 0 && <li key={id}>{leadSentence(baseline.label, label, leads)}</li>;
        })}
      </Box>
      <Note className={ui.note ?? ""}>
        Share of the points at which {baseline.label} has the lower value; below, how much higher the other strategy is:
        in the scenario itself, then the median and the range of 90 % of the points.
      </Note>
      <DataTable
        label="Leads"
        rows={others}
        rowKey={({ id }) => id}
        rowAttributes={({ id }) => ({ "data-strategy": id })}
        columns={[
          { key: "strategy", head: "Against", text: true, cell: (strategy) => <StrategyName strategy={strategy} /> },
          ...figures.map(({ key, label, group }): Column<Strategy> => ({
            key,
            head: label,
            group,
            attributes: () => ({ "data-cell": key }),
            cell: ({ id }) => <Lead summary={summary} margin={summary.strategies[id]?.figures[key]?.margin} />,
          })),
        ]}
      />
    </Card>
  );
}

const whole = (share: number) => `${Math.round(100 * share)}\u2009%`;

const plain = (percent: number | null) =>
  percent === null ? "–" : formatPercent(Math.round(percent)).replace(".0", "");

function Lead({ summary, margin }: { readonly summary: BatchSummary; readonly margin: Margin | null | undefined }) {
  // The margin is the other strategy's: where that is worse, the baseline is better.
  if (typeof margin?.worse !== "number") return "–";
  const { worse } = margin;
  return (
    <>
      <Box component="span" display="block" fw={650}>
        {whole(worse)}
      </Box>
      <Progress.Root size={5} m="2px 0 3px" bg="color-mix(in srgb, var(--worse) 45%, transparent)" aria-hidden>
        <Progress.Section withAria={false} value={100 * worse} color="var(--accent)" />
      </Progress.Root>
      <span className={ui.under}>
        {plain(margin.nominal)} → <b>{plain(quantile(summary, margin, 50))}</b>
      </span>
      <span className={ui.under}>
        {plain(quantile(summary, margin, 5))} … {plain(quantile(summary, margin, 95))}
      </span>
    </>
  );
}

interface LeadOf {
  /** Share of the points at which the other strategy is worse, and better. */
  readonly worse: number;
  readonly better: number;
}

/** `LV control is better than LQR in 7 of 8 metrics at most points, in 5 of them at 95 % and more; worse in 1.` */
export function leadSentence(label: string, other: string, leads: readonly LeadOf[]): string {
  const count = (test: (lead: LeadOf) => boolean) => formatWhole(leads.filter(test).length);
  const [betterIn, certainlyBetterIn, worseIn] = [
    count(({ worse }) => worse > 0.5),
    count(({ worse }) => worse >= 0.95),
    count(({ better }) => better > 0.5),
  ];
  const certain =
    certainlyBetterIn === "0" ? "nowhere at 95 % of them" : `in ${certainlyBetterIn} at 95 % of them and more`;
  return `${label} is better than ${other} in ${betterIn} of ${leads.length} metrics at most points, ${certain}${worseIn === "0" ? "" : `; worse in ${worseIn}`}.`;
}
