/** The result in one sentence, for eyes and for screen readers, and the way to a comparison at equal speed. */

import { Button, Group, Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useState } from "react";
import type { Catalogue, OverRoads, Strategy, StrategyId } from "../../api/types";
import { useAction, useActionButton } from "../../lab/actions";
import { useEdit, useLab, useReadOnly } from "../../lab/context";
import type { ResultView } from "../../lab/resultView";
import type { Result } from "../../lab/result";
import { setAt } from "../../scenario/path";
import { changesQuery } from "../../server/queries";
import { useLabels, type Labels } from "../../server/useCatalogues";
import { CaveatMark } from "../tables/ChangeMark";
import { caveatsOf, formatPercent, type Change, type Verdict } from "../tables/change";
import { formatFixed } from "../../units/format";
import { changeBetween, comparedMetrics, isRandom, oneRoadNoiseOf } from "../tables/entries";
import { valueAt, type WindowMetric } from "../../lab/metricPath";

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

export function VerdictLine({ resultView }: { readonly resultView: ResultView }) {
  const { catalogue, unit } = useLabels();
  const { shown, strategies, baseline, summaries } = resultView;
  const leader = leaderOf(resultView, catalogue);
  const rival = leader && rivalOf(resultView, leader, baseline);
  const paired = {
    [leader?.id ?? ""]: usePairedChanges(shown, leader && { baseline: leader.id }),
    [rival?.id ?? ""]: usePairedChanges(shown, rival && { baseline: rival.id }),
  };
  const sentence = leader && rival && sentenceOf(resultView, { ...catalogue, unit }, { leader, rival }, paired);
  const stale = useLab((state) => state.stale);
  // A screen reader is told of results, not of each step of a slider.
  const [announced, setAnnounced] = useState("");
  const text = sentence ? sentence.lead + sentence.rest : "";
  if (shown.source === "exact" && !stale && text !== announced) setAnnounced(text);
  return (
    <Group gap="0.2rem 0.7rem" p="0 0.2rem" fz="sm" lh={1.4} data-testid="verdict">
      <p className="visually-hidden" role="status">
        {announced}
      </p>
      <Text component="p" inherit aria-hidden>
        {sentence ? (
          <>
            <strong>{sentence.lead}</strong>
            {sentence.rest}
          </>
        ) : strategies.length < 2 ? (
          "One strategy is shown: switch on another to see which is best."
        ) : (
          "\u00a0"
        )}
      </Text>
      {leader && <CaveatMark caveats={caveatsOf(summaries[leader.id]?.events, catalogue)} />}
    </Group>
  );
}

/** Lets every strategy slow down as LV control does, so that only the suspensions differ. */
export function EqualSpeed({ resultView }: { readonly resultView: ResultView }) {
  const edit = useEdit();
  const readOnly = useReadOnly();
  const differ = !readOnly && speedsOf(resultView).length > 1;
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

type Compared = Pick<ResultView, "shown" | "strategies" | "summaries">;
type Signals = Pick<Catalogue, "paper_signals" | "signals">;
/** With the units that changes are shown in: what is zero is so in them. */
type InUnits = Signals & Pick<Labels, "unit">;
/** By baseline what the result's roads say against it, paired by road. */
export type PairedAgainst = Readonly<Record<StrategyId, OverRoads["changes"] | undefined>>;

/** The metrics of the paper that this run has. */
const metricsOf = ({ strategies, summaries }: Compared, catalogue: Signals) =>
  comparedMetrics(catalogue).filter((metric) =>
    strategies.every(({ id }) => typeof valueAt(summaries[id], metric) === "number"),
  );

/** The strategy with the lowest value in most metrics; `null` where there is nothing to win. */
export function leaderOf(compared: Compared, catalogue: Signals): Strategy | null {
  const { strategies, summaries } = compared;
  const metrics = metricsOf(compared, catalogue);
  if (strategies.length < 2 || metrics.length === 0) return null;
  const lowest = (metric: WindowMetric) =>
    Math.min(...strategies.map(({ id }) => valueAt(summaries[id], metric) ?? Infinity));
  const wins = ({ id }: Strategy) =>
    metrics.filter((metric) => valueAt(summaries[id], metric) === lowest(metric)).length;
  return strategies.reduce((best, each) => (wins(each) > wins(best) ? each : best));
}

/** The strategy that the headline's change is against: the baseline, or where that leads the best of the others. */
export function rivalOf({ strategies, summaries }: Compared, leader: Strategy, baseline: StrategyId | null): Strategy {
  const others = strategies.filter(({ id }) => id !== leader.id);
  const value = ({ id }: Strategy) => valueAt(summaries[id], headlineOf(summaries[id])) ?? Infinity;
  return (
    others.find(({ id }) => id === baseline) ??
    others.reduce((best, each) => (value(each) < value(best) ? each : best), others[0] ?? leader)
  );
}

const ON_BUMP: WindowMetric = { window: "bump", signal: "body_acceleration", statistic: "peak" };
const ON_ROUGH_ROAD: WindowMetric = { window: "rough_road", signal: "body_acceleration", statistic: "rms" };

/** The comfort on the bump; of a road without one that on the rough road. */
const headlineOf = (summary: Parameters<typeof valueAt>[0]): WindowMetric =>
  typeof valueAt(summary, ON_BUMP) === "number" ? ON_BUMP : ON_ROUGH_ROAD;

function between(
  { shown, summaries }: Compared,
  { unit }: InUnits,
  [one, other]: readonly [Strategy, Strategy],
  metric: WindowMetric,
  paired: PairedAgainst,
): Change | null {
  return changeBetween(
    { strategy: one, shown, summary: summaries[one.id] },
    { summary: summaries[other.id], scenario: shown.scenario, pair: [one, other] },
    { metric, scale: unit(metric.signal).scale, paired: paired[other.id] },
  );
}

/** In how many metrics the leader is better than every other, or worse than one of them, for sure. */
interface Score {
  readonly best: number;
  readonly behind: number;
  /** On one road: in how many it is level with at least one other, and better than the rest. */
  readonly equal: number;
  readonly of: number;
}

/** `null` until the roads' changes are there. */
export function scoreOf(compared: Compared, catalogue: InUnits, leader: Strategy, paired: PairedAgainst): Score | null {
  const others = compared.strategies.filter(({ id }) => id !== leader.id);
  const verdicts = metricsOf(compared, catalogue).map((metric) =>
    others.map((other) => {
      const verdict = between(compared, catalogue, [other, leader], metric, paired)?.verdict ?? null;
      // On one road only against a leader that is at zero, where the other is not.
      return verdict === "none" && !compared.shown.over ? "worse" : verdict;
    }),
  );
  if (verdicts.flat().includes(null)) return null;
  const count = (test: (each: readonly (Verdict | null)[]) => boolean) => verdicts.filter(test).length;
  return {
    best: count((each) => each.every((verdict) => verdict === "worse")),
    behind: count((each) => each.includes("better")),
    equal: compared.shown.over
      ? 0
      : count((each) => each.includes("same") && each.every((verdict) => verdict === "same" || verdict === "worse")),
    of: verdicts.length,
  };
}

/** Arrival speeds closer than this part of each other print the same or nearly so. */
const SAME_SPEED = 0.01;

/** The speeds at which the strategies meet the bump, lowest first; one where all do so alike. */
export function speedsOf({ strategies, summaries }: Compared): readonly number[] {
  const speeds = strategies.flatMap(({ id }) => summaries[id]?.arrival_speed_kmh ?? []).sort((a, b) => a - b);
  const [low = 0, high = 0] = [speeds[0], speeds.at(-1)];
  return high - low <= SAME_SPEED * high ? speeds.slice(0, 1) : speeds;
}

const kmh = (speed: number) => formatFixed(speed, speed < 99.95 ? 1 : 0);

function speedText(compared: Compared, leader: Strategy, rival: Strategy): string {
  const speeds = speedsOf(compared);
  const [low] = speeds;
  if (low === undefined) return "";
  if (speeds.length === 1) return `, all at ${kmh(low)} km/h`;
  const [own, other] = [leader, rival].map(({ id }) => kmh(compared.summaries[id]?.arrival_speed_kmh ?? 0));
  return own === other
    ? `, both at ${own} km/h; speeds are ${kmh(low)} to ${kmh(speeds.at(-1) ?? low)} km/h`
    : `, at ${own} instead of ${other} km/h`;
}

/** The change, and how sure it is; one that may be luck is none. */
function changeText({ percent, half, verdict }: Change, { shown: { over } }: Compared, oneRoadNoise: number): string {
  if (verdict === "same" && !over) return "no different";
  if (percent === null) return "not to be compared in percent";
  if (verdict === "luck" || verdict === "same") return "no different beyond luck";
  return `${formatPercent(percent, half)}${over || oneRoadNoise === 0 ? "" : ` (luck ±\u2009${oneRoadNoise.toFixed(0)}\u2009%)`}`;
}

interface Sentence {
  /** Who wins. */
  readonly lead: string;
  /** By how much, and at which speeds. */
  readonly rest: string;
}

/** The verdict in words; `null` where nothing is compared, or not yet. */
export function sentenceOf(
  compared: Compared,
  catalogue: InUnits,
  { leader, rival }: { readonly leader: Strategy; readonly rival: Strategy },
  paired: PairedAgainst,
): Sentence | null {
  const score = scoreOf(compared, catalogue, leader, paired);
  const metric = headlineOf(compared.summaries[leader.id]);
  const change = between(compared, catalogue, [leader, rival], metric, paired);
  if (score === null || change === null) return null;
  const { best, behind, equal, of } = score;
  const noise = oneRoadNoiseOf([leader, rival], metric, isRandom(compared.shown.scenario));
  const luck = compared.shown.over || noise > 0 ? of - best - behind - equal : 0;
  const lead = best > 0 ? `${leader.label} is best in ${best} of ${of} metrics` : `No clear winner in ${of} metrics`;
  const remainder = [
    behind > 0 && `behind in ${behind}`,
    equal > 0 && `equal in ${equal}`,
    luck > 0 && `within luck in ${luck}`,
  ].filter(Boolean);
  const name = catalogue.signals.find(({ key }) => key === metric.signal)?.label.toLowerCase() ?? metric.signal;
  const figure = metric.window === "bump" ? `Peak ${name} on the bump` : `RMS ${name} on the rough road`;
  const size = changeText(change, compared, noise);
  const listed = remainder.map((part) => `, ${part}`).join("");
  const who = best > 0 ? "" : `${leader.label} `;
  return {
    lead,
    rest: `${listed}. ${figure} ${who}${size} against ${rival.label}${speedText(compared, leader, rival)}.`,
  };
}
