/** What a study says: who keeps the lead, how far every figure spreads, what is stable, what it depends on. */

import { Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useNavigate, useSearch } from "@tanstack/react-router";
import { useMemo } from "react";
import { isFinal } from "../../jobs/follow";
import type { Catalogue } from "../../api/types";
import { paperFigures } from "../../server/metrics";
import { formatWhole } from "../../units/format";
import { Leads } from "./Leads";
import { Limits } from "./Limits";
import { Matters } from "./Matters";
import { OneByOne } from "./OneAtATime";
import { Spread } from "./Spread";
import { AIRBORNE, summaryQuery, TRAVEL } from "./summary";
import { Unstable } from "./Unstable";
import { useOpenRun } from "../../features/sweep/useOpenRun";
import { Fault } from "../../ui/Fault";
import ui from "../../ui/ui.module.css";
import { Loading } from "../../ui/Loading";
import type { StudyParts } from "./props";

/** Fewer finished points are no spread to look at. */
const LEAST_POINTS = 10;

interface Props extends Pick<StudyParts, "batch" | "figures" | "strategies"> {
  readonly catalogue: Catalogue;
}

export function StudyResults({ batch, figures, strategies, catalogue }: Props) {
  const { baseline = null, one } = useSearch({ from: "/robustness/$id" });
  const navigate = useNavigate({ from: "/robustness/$id" });
  const paper = useMemo(
    () => paperFigures(catalogue).flatMap((key) => figures.find((figure) => figure.key === key) ?? []),
    [catalogue, figures],
  );
  const columns = useMemo(() => [...paper.map(({ key }) => key), TRAVEL, AIRBORNE], [paper]);
  const query = useQuery(summaryQuery(batch, columns, baseline));
  const opening = useOpenRun(batch);
  const summary = query.data;
  const ended = isFinal(batch);

  if (query.isError && !summary) {
    return <Fault size="sm">The study could not be read: {query.error.message}</Fault>;
  }
  const finished = summary ? Math.min(...Object.values(summary.strategies).map(({ ok }) => ok)) : 0;
  if (!summary || (!ended && finished < LEAST_POINTS)) {
    if (ended && batch.done === 0 && batch.failed === 0)
      return <Text c="dimmed">No run has finished: there are no results.</Text>;
    return (
      <div className={ui.stack}>
        {!ended && (
          <Text size="sm" c="dimmed">
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
        <Text size="sm" className={ui.warning} role="status">
          {ended ? "At" : "So far at"} least {formatWhole(finished)} of {formatWhole(summary.points)} points have run
          under each strategy; the figures below are of those.
        </Text>
      )}
      {opening.error !== null && <Fault size="sm">This run could not be opened: {opening.error}</Fault>}
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
      {one !== undefined && <OneByOne id={one} {...{ figures, strategies }} paper={paper} />}
      <Text size="xs" c="dimmed">
        Percentiles lie between two values by distance. Every strategy runs at the same points; changes are taken point
        by point. The ranges are ours, not the paper’s: 5 and 95 % of these points say nothing about 5 and 95 % of real
        cars.
      </Text>
    </div>
  );
}
