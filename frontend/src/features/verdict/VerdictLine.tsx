/** The result in one sentence, for eyes and for screen readers, and the way to a comparison at equal speed. */

import { Button } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useState } from "react";
import type { Catalogue, OverRoads } from "../../api/types";
import { useEdit, useLab, useReadOnly } from "../../lab/context";
import type { ResultView } from "../../lab/resultView";
import type { Result } from "../../lab/result";
import { setAt } from "../../scenario/path";
import { changesQuery } from "../../server/queries";
import { CaveatMark } from "../tables/ChangeMark";
import { caveatsOf } from "../tables/caveats";
import { leaderOf, rivalOf, sentenceOf, speedsOf } from "./verdict";
import classes from "./verdict.module.css";

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

interface Props {
  readonly resultView: ResultView;
  readonly catalogue: Catalogue;
}

export function VerdictLine({ resultView, catalogue }: Props) {
  const { shown, strategies, baseline, summaries } = resultView;
  const leader = leaderOf(resultView, catalogue);
  const rival = leader && rivalOf(resultView, leader, baseline);
  const paired = {
    [leader?.id ?? ""]: usePairedChanges(shown, leader && { baseline: leader.id }),
    [rival?.id ?? ""]: usePairedChanges(shown, rival && { baseline: rival.id }),
  };
  const sentence = leader && rival && sentenceOf(resultView, catalogue, { leader, rival }, paired);
  const stale = useLab((state) => state.stale);
  // A screen reader is told of results, not of each step of a slider.
  const [announced, setAnnounced] = useState("");
  const text = sentence ? sentence.lead + sentence.rest : "";
  if (shown.source === "exact" && !stale && text !== announced) setAnnounced(text);
  return (
    <div className={classes.verdict} data-testid="verdict">
      <p className="visually-hidden" role="status">
        {announced}
      </p>
      <p aria-hidden>
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
      </p>
      {leader && <CaveatMark caveats={caveatsOf(summaries[leader.id]?.events, catalogue)} />}
    </div>
  );
}

/** Lets every strategy slow down as LV control does, so that only the suspensions differ. */
export function EqualSpeed({ resultView }: { readonly resultView: ResultView }) {
  const edit = useEdit();
  const readOnly = useReadOnly();
  if (readOnly || speedsOf(resultView).length < 2) return null;
  return (
    <Button
      size="compact-xs"
      variant="light"
      data-unprinted
      onClick={() => edit.commit(setAt(edit.newest(), "/speed/policy", "planned"))}
    >
      Compare at equal speed
    </Button>
  );
}
