/** Controllers of one's own: their files are saved, break and go away while their results are shown. */

import { useEffect, useMemo, useRef } from "react";
import type { Strategy, Summary } from "../api/types";
import { isRecording } from "../lib/recording";
import { lawsOf } from "../server/queries";
import { useLab, useLabContext } from "./context";

/** Runs what is shown again where the file of one that is chosen was saved. */
export function useSavedLaws(strategies: readonly Strategy[]): void {
  const { lab } = useLabContext();
  const laws = lawsOf(strategies);
  const lastLaws = useRef(laws);
  useEffect(() => {
    if (lastLaws.current === laws) return;
    lastLaws.current = laws;
    const { shown, strategies: switchedOn } = lab.get();
    const isOld = ({ id, own, source }: Strategy) =>
      own && switchedOn.includes(id) && shown?.summaries[id]?.source?.digest !== source?.digest;
    if (shown && strategies.some(isOld)) lab.runAgain();
  }, [laws, strategies, lab]);
}

/** The strategies, and those of the shown result that are there no more: their numbers stay. */
export function useWithGone(strategies: readonly Strategy[]): readonly Strategy[] {
  const gone = useLab(({ shown }) =>
    Object.keys(shown?.summaries ?? {})
      .filter((id) => !isRecording(id) && strategies.every((strategy) => strategy.id !== id))
      .join(),
  );
  return useMemo(
    () => (gone === "" ? strategies : [...strategies, ...gone.split(",").map(goneLaw)]),
    [gone, strategies],
  );
}

const GREY = "#868E96";

const goneLaw = (id: string): Strategy => ({
  id,
  label: id,
  description: "Its file is there no more: these are the numbers that were stored.",
  reads: [],
  colour: GREY,
  dark_colour: GREY,
  dash: "solid",
  own: true,
  source: null,
  options: {},
  fault: null,
  one_road_resolution: {},
});

/** What is to be said of results whose law is another one by now, or gone. */
export function lawsText(strategies: readonly Strategy[], summaries: Readonly<Record<string, Summary>>) {
  const of = (isSo: (strategy: Strategy | undefined) => boolean) =>
    Object.entries(summaries).flatMap(([id, { source }]) => {
      const strategy = strategies.find((each) => each.id === id);
      return source && isSo(strategy) && strategy?.source?.digest !== source.digest ? [`${id} (${source.file})`] : [];
    });
  return { changed: of((strategy) => Boolean(strategy)), gone: of((strategy) => !strategy) };
}
