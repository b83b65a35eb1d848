/** How results keep requirements, for tables, chips and the list. */

import type { RequirementResult, StrategyId, Summary } from "../../api/types";
import { valueNamed } from "../../lab/metricPath";
import { limitOf, type Judged, type LimitKind, type Requirement } from "../../lab/requirements";
import type { Result } from "../../lab/result";
import type { Metric } from "../../server/metrics";
import { formatInput, prettyUnit } from "../../units/format";
import { useQueries, type UseQueryResult } from "@tanstack/react-query";
import { useCallback, useMemo } from "react";
import type { Compared } from "../../lab/compare";
import type { PartShown } from "../../lab/resultView";
import { judgedQuery } from "../../server/queries";

interface Judgeable {
  readonly shown: Pick<Result, "runId">;
  readonly strategy: { readonly id: StrategyId };
}

/** How one road's summaries keep requirements, as the service judges one road: what is shown until it has, and while somebody drags. */
export function judgedHere(
  summaries: Readonly<Record<StrategyId, Summary>>,
  requirements: readonly Requirement[],
  baseline: StrategyId,
): readonly RequirementResult[] {
  const names = Object.keys(summaries);
  const others = names.filter((id) => id !== baseline);
  return requirements.flatMap((requirement): readonly RequirementResult[] => {
    const { metric } = requirement;
    const { kind, value: limit } = limitOf(requirement);
    const isChange = kind === "max_change";
    const usual = isChange || others.length > 0 ? others : names;
    const base = isChange ? valueNamed(summaries[baseline], metric) : 100;
    return (requirement.strategies ?? usual).map((strategy) => {
      const own = valueNamed(summaries[strategy], metric);
      const change = own === null || base === null || (base === 0 && own !== 0) ? null : base && 100 * (own / base - 1);
      const value = isChange ? change : own;
      const keeps = value !== null && (kind === "min" ? value >= limit : value <= limit);
      const none = { max: null, min: null, max_change: null, low: null, high: null };
      const head = { ...none, metric, strategy, value, [kind]: limit, baseline: isChange ? baseline : null };
      return { ...head, result: keeps ? "pass" : "fail", reason: value === null ? "It has no such metric" : null };
    });
  });
}

/** How one strategy of a result keeps what is required of a metric. */
export const requiredOf = (
  judged: Judged,
  { shown, strategy }: Judgeable,
  metric: string,
): readonly RequirementResult[] =>
  (judged[shown.runId ?? ""] ?? []).filter((each) => each.strategy === strategy.id && each.metric === metric);

/** Those of the list that are about this requirement. */
export function resultsOf(requirement: Requirement, results: readonly RequirementResult[]) {
  const { kind, value } = limitOf(requirement);
  return results.filter(
    (each) =>
      each.metric === requirement.metric &&
      each[kind] === value &&
      (requirement.strategies ?? [each.strategy]).includes(each.strategy),
  );
}

export const LIMIT_WORDS: Readonly<Record<LimitKind, string>> = {
  max: "at most",
  min: "at least",
  max_change: "changes by at most",
};

export const RESULT_WORDS = { pass: "pass", fail: "fail", uncertain: "uncertain" } as const;

/** In the unit that it is shown in. */
export const shownLimit = (kind: LimitKind, value: number, figure: Metric | undefined): number =>
  Number((kind === "max_change" ? value : value * (figure?.scale ?? 1)).toPrecision(12));

export const limitUnit = (kind: LimitKind, figure: Metric | undefined): string =>
  kind === "max_change" ? "%" : (figure?.unit ?? "1");

/** `at most 3 m/s²`, `changes by at most −20 % against Passive`. */
export function limitText(
  requirement: Pick<Requirement, LimitKind>,
  figure: Metric | undefined,
  baseline: string | null = null,
): string {
  const { kind, value } = limitOf(requirement);
  const number = `${formatInput(shownLimit(kind, value, figure))} ${prettyUnit(limitUnit(kind, figure))}`.trim();
  return `${LIMIT_WORDS[kind]} ${number}${baseline === null ? "" : ` against ${baseline}`}`;
}

/** How the shown result, under a moving slider too, and those it is compared with keep the requirements. */
export function useJudged(
  part: PartShown | null,
  { pins }: Compared,
  requirements: readonly Requirement[],
  baseline: StrategyId,
): Judged {
  const shown = part?.shown;
  const asked = useMemo(() => {
    const results = shown && requirements.length > 0 ? [shown, ...pins.map((pin) => pin.shown)] : [];
    const runs = results.flatMap(({ runId, summaries, failed }) => {
      const hasBaseline = baseline in summaries || failed.some(({ strategy }) => strategy === baseline);
      return runId === null ? [] : [[runId, hasBaseline ? baseline : null] as const];
    });
    return [...new Map(runs)];
  }, [shown, pins, requirements, baseline]);
  const here = useMemo(
    () =>
      shown?.over === null && requirements.length > 0
        ? { [shown.runId ?? ""]: judgedHere(shown.summaries, requirements, baseline) }
        : {},
    [shown, requirements, baseline],
  );
  const stored = useQueries({
    queries: asked.map(([run, base]) => judgedQuery(run, requirements, base)),
    combine: useCallback(
      (results: readonly UseQueryResult<readonly RequirementResult[]>[]): Judged =>
        Object.fromEntries(
          asked.flatMap(([run], index) => {
            const data = results[index]?.data;
            return data === undefined ? [] : [[run, data]];
          }),
        ),
      [asked],
    ),
  });
  return useMemo(() => ({ ...here, ...stored }), [here, stored]);
}
