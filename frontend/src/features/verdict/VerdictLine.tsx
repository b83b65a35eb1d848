/** The service's verdict on what is shown, for eyes and for screen readers, and the way to a comparison at equal speed. */

import { Button, Group, Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useState } from "react";
import {
  type Comparison,
  type OverRoads,
  type Scenario,
  type Catalogue,
  type Strategy,
  type StrategyId,
} from "../../api/types";
import { useAction, useActionButton } from "../../lab/actions";
import { useEdit, useLab, useReadOnly, useLabContext } from "../../lab/context";
import { type ResultView } from "../../lab/resultView";
import { type Result } from "../../lab/result";
import { isRecording } from "../../lib/recording";
import { sameValue, setAt } from "../../scenario/path";
import { changesQuery, comparisonQuery } from "../../server/queries";
import { useLabels, type Labels } from "../../server/useCatalogues";
import { CaveatMark, ChangeText } from "../tables/ChangeMark";
import { caveatsOf, type Change } from "../tables/change";
import { whyNotCompared, type Variant } from "../../lab/compare";
import { labelled, Choice } from "../../ui/Entry";
import { VIEWS, changeBetween, comparedMetrics } from "../tables/entries";
import { metricName, type WindowMetric } from "../../lab/metricPath";
import { requiredOf } from "../requirements/judged";
import ui from "../../ui/ui.module.css";
import { RequirementMarks } from "../requirements/RequirementsCard";

/** What a result's roads say against one of its strategies or another run; undefined until they do, and of one road. */
export function usePairedChanges(
  { over, runId }: Result,
  refersTo: Parameters<typeof changesQuery>[1] | null,
): OverRoads["changes"] | undefined {
  const own = refersTo && "baseline" in refersTo && over?.baseline === refersTo.baseline ? over.changes : undefined;
  const asked = over !== null && runId !== null && refersTo !== null && own === undefined;
  const { data } = useQuery({ ...changesQuery(runId ?? "", refersTo ?? { baseline: "" }), enabled: asked });
  return own ?? (asked ? data?.changes : undefined);
}

/** What a result's own comparison is of: it came with the result, for the strategies that were asked for. */
function isOfWhatIsShown({ shown, ids, baseline }: Pick<ResultView, "shown" | "ids" | "baseline">): boolean {
  const { comparison, source, summaries } = shown;
  if (comparison === undefined || comparison.baseline !== baseline) return false;
  return source === "live" || Object.keys(summaries).every((id) => id === baseline || ids.includes(id));
}

/** A comparison, with what it is of. */
interface Compared extends Pick<ResultView, "baseline"> {
  readonly comparison: Comparison;
  readonly scenario: Scenario;
}

interface ShownComparison {
  readonly comparison: Comparison | undefined;
  /** Whether it is of other strategies than those that are shown: the newest is on its way. */
  readonly isOlder: boolean;
}

/** The comparison to show: the newest; while that is on its way, the last of the same scenario and baseline; else none. */
export function shownComparison(
  newest: Comparison | undefined,
  last: Compared | null,
  now: Omit<Compared, "comparison"> & { readonly isAsked: boolean },
): ShownComparison {
  if (newest !== undefined) return { comparison: newest, isOlder: false };
  const isOlder =
    last !== null && now.isAsked && last.baseline === now.baseline && sameValue(last.scenario, now.scenario);
  return { comparison: isOlder ? last.comparison : undefined, isOlder };
}

function useComparison(resultView: ResultView): ShownComparison {
  const { shown, ids, baseline } = resultView;
  const own = isOfWhatIsShown(resultView) ? shown.comparison : undefined;
  const question = own || shown.runId === null || baseline === null ? null : { baseline, compare: ids.join(",") };
  const { data, isFetching } = useQuery({
    ...comparisonQuery(shown.runId ?? "", question ?? { baseline: "", compare: "" }),
    enabled: question !== null,
  });
  const newest = own ?? (question ? data : undefined);
  const { scenario } = shown;
  const [last, setLast] = useState<Compared | null>(null);
  if (newest !== undefined && newest !== last?.comparison) setLast({ comparison: newest, scenario, baseline });
  return shownComparison(newest, last, { scenario, baseline, isAsked: question !== null && isFetching });
}

/** Why there is no comparison with the chosen baseline: a recorded drive is compared with exact runs alone. */
export function whyNoComparison({
  shown,
  baseline,
  catalogue,
}: Pick<ResultView, "shown" | "baseline" | "catalogue">): string {
  if (shown.source !== "live" || baseline === null || !isRecording(baseline)) return "";
  const label = catalogue.find(({ id }) => id === baseline)?.label ?? baseline;
  return `The comparison with ${label} comes with the exact run.`;
}

export function VerdictLine({ resultView }: { readonly resultView: ResultView }) {
  const { shown, ids, baseline, summaries } = resultView;
  const { comparison, isOlder } = useComparison(resultView);
  const stale = useLab((state) => state.stale);
  const isAlone = ids.length < 2 && (baseline === null || ids.includes(baseline));
  const text = isAlone ? "" : (comparison?.verdict.text ?? whyNoComparison(resultView));
  // A screen reader is told of results, not of each step of a slider.
  const [announced, setAnnounced] = useState("");
  if (shown.source === "exact" && !stale && !isOlder && text !== announced) setAnnounced(text);
  const [lead = "", ...rest] = text.split(/(?<=\.) /);
  return (
    <Group gap="0.2rem 0.7rem" p="0 0.2rem" fz="sm" lh={1.4} data-testid="verdict">
      <p className="visually-hidden" role="status">
        {announced}
      </p>
      <Text component="p" inherit aria-hidden {...(isOlder && { c: "dimmed", "data-older": true })}>
        {isAlone ? (
          "One strategy is shown: switch on another to see which is best."
        ) : (
          <>
            <strong>{lead || "\u00a0"}</strong> {rest.join(" ")}
          </>
        )}
      </Text>
      {!isAlone && comparison && <Warnings best={comparison.verdict.best} {...{ summaries }} />}
    </Group>
  );
}

interface WarningsProps extends Pick<ResultView, "summaries"> {
  readonly best: Comparison["verdict"]["best"];
}

/** Why a result that the verdict calls best is one that no real car would have had. */
function Warnings({ best, summaries }: WarningsProps) {
  const { catalogue, strategy } = useLabels();
  const winners = [...new Set(Object.values(best))].flatMap((id) => (id === null ? [] : [id]));
  return winners.map((id) => {
    const caveats = caveatsOf(summaries[id]?.events, catalogue);
    if (caveats.length === 0) return null;
    return (
      <Group key={id} component="span" gap="0.3rem" fz="xs">
        {winners.length > 1 && `${strategy(id)}:`} <CaveatMark caveats={caveats} />
      </Group>
    );
  });
}

/** Arrival speeds closer than this part of each other print the same or nearly so. */
const SAME_SPEED = 0.01;

/** Whether the strategies meet the bump at different speeds. */
export function speedsDiffer({ strategies, summaries }: Pick<ResultView, "strategies" | "summaries">): boolean {
  const speeds = strategies.flatMap(({ id }) => summaries[id]?.arrival_speed_kmh ?? []);
  return Math.max(...speeds) - Math.min(...speeds) > SAME_SPEED * Math.max(...speeds);
}

/** Lets every strategy slow down as LV control does, so that only the suspensions differ. */
export function EqualSpeed({ resultView }: { readonly resultView: ResultView }) {
  const edit = useEdit();
  const readOnly = useReadOnly();
  const differ = !readOnly && speedsDiffer(resultView);
  useAction("equalSpeed", differ ? () => edit.commit(setAt(edit.newest(), "/speed/policy", "planned")) : null);
  const { label, ...button } = useActionButton("equalSpeed");
  return (
    differ && (
      <Button size="compact-xs" variant="light" data-unprinted {...button}>
        {label}
      </Button>
    )
  );
}

/** What the last edit changed: a chip for each of the eight metrics, which leads to its plot. */
const LOOK = { gap: "0.25rem 0.5rem", mih: 30, px: "0.2rem", fz: "xs", c: "dimmed" };

export function ChangeChips({ resultView }: { readonly resultView: ResultView }) {
  const words = useLabels();
  const { before, shown, strategies } = resultView;
  const [picked, setPicked] = useState<string | null>(null);
  const readOnly = useReadOnly();
  const unlike = before && whyNotCompared(shown, before.shown);
  const paired = usePairedChanges(
    shown,
    unlike === null && before?.shown.runId ? { against: before.shown.runId } : null,
  );
  const note =
    before === null
      ? "After an edit, what it changes in eight metrics stands here."
      : unlike !== null && `The state before is ${unlike}: its changes are not shown.`;
  if (before === null && readOnly) return null;
  if (before === null || note)
    return (
      <Group {...LOOK} data-unprinted>
        {note} <EqualSpeed resultView={resultView} />
      </Group>
    );
  const changes = editChanges(resultView, before, { ...words.catalogue, unit: words.unit }, paired);
  const strategy = strategies.find(({ id }) => id === picked) ?? changedMost(changes, strategies);
  const of = changes.filter((each) => each.strategy === strategy?.id);
  return (
    <Group {...LOOK} data-unprinted role="group" aria-label={`Changes against the state ${before.name}`}>
      <Choice
        size="xs"
        aria-label="Changes of"
        value={strategy?.id}
        data={labelled(strategies)}
        w="7.5rem"
        onPick={setPicked}
      />
      {VIEWS.map((view) => (
        <Group key={view.window} component="span" gap="0.2rem" title={words.view(view)}>
          {windowName(view.window)}
          {of
            .filter(({ metric }) => metric.window === view.window)
            .map(({ metric, change }) => (
              <ChangeChip
                key={metric.signal}
                metric={metric}
                label={words.signal(metric.signal)}
                change={change}
                required={strategy ? requiredOf(resultView.judged, { shown, strategy }, metricName(metric)) : []}
              />
            ))}
        </Group>
      ))}
      <EqualSpeed resultView={resultView} />
    </Group>
  );
}

const windowName = (window: string) => (window === "bump" ? "Bump" : "Rough road");

interface ChipProps {
  readonly metric: WindowMetric;
  readonly label: string;
  readonly change: Parameters<typeof ChangeText>[0]["change"];
  readonly required: Parameters<typeof RequirementMarks>[0]["results"];
}

function ChangeChip({ metric: { window, signal }, label, change, required }: ChipProps) {
  const { labAddress } = useLabContext();
  const show = () => {
    labAddress.setView({ zoom: window === "bump" ? null : "whole" });
    document.querySelector(`[data-figure="${signal}"]`)?.scrollIntoView({ block: "center" });
  };
  return (
    <button
      type="button"
      className={ui.pill}
      data-verdict={change?.verdict}
      title={`${label}: show its plot`}
      onClick={show}
    >
      <span aria-hidden>{shortName(label)}</span>
      <span className="visually-hidden">{label}</span> <ChangeText change={change} />
      <RequirementMarks results={required} />
    </button>
  );
}

interface EditChange {
  readonly strategy: StrategyId;
  readonly metric: WindowMetric;
  /** `null` until it is there. */
  readonly change: Change | null;
}

/** Each strategy's eight metrics against its own before. */
export function editChanges(
  { shown, strategies, summaries }: Pick<ResultView, "shown" | "strategies" | "summaries">,
  before: Variant,
  catalogue: Pick<Catalogue, "paper_signals"> & Pick<Labels, "unit">,
  paired: OverRoads["changes"] | undefined,
): readonly EditChange[] {
  return strategies.flatMap((strategy) =>
    comparedMetrics(catalogue).map((metric) => ({
      strategy: strategy.id,
      metric,
      change: changeBetween(
        { strategy, shown, summary: summaries[strategy.id] },
        { summary: before.shown.summaries[strategy.id], scenario: before.shown.scenario, pair: [strategy] },
        { metric, scale: catalogue.unit(metric.signal).scale, paired },
      ),
    })),
  );
}

/** The strategy that the edit moved in most metrics; the first where it moved none. */
export function changedMost(changes: readonly EditChange[], strategies: readonly Strategy[]): Strategy | undefined {
  const moved = ({ id }: Strategy) =>
    changes.filter(
      ({ strategy, change }) => strategy === id && change !== null && change.percent !== null && change.percent !== 0,
    ).length;
  return strategies.toSorted((one, other) => moved(other) - moved(one))[0];
}

/** `Front tyre` of `Front tyre dynamic load`: enough beside its plot's window. */
const shortName = (label: string): string => label.replace(/ (acceleration|dynamic load)$/, "");
