/** A link's view and the page's: how it is looked at, there and back. */

import { type Link, type SharedView, type StrategyId } from "../api/types";
import type { View, ViewZoom } from "./address";
import { pinReference } from "./compare";
import type { ResultView } from "./resultView";

export interface ReadView {
  readonly view: View;
  /** Strategies that are switched on. */
  readonly strategies: readonly StrategyId[];
  /** Where the cursor stands. */
  readonly at: number | null;
}

/** A link made by a script may say nothing of the view: then everything of the run is shown. */
export function readSharedView({
  view,
  run,
  requirements = [],
}: Pick<Link, "view" | "run" | "requirements">): ReadView {
  const computed = Object.keys(run?.strategies ?? {});
  const shown = view.strategies ?? computed;
  const strategies = computed.filter((id) => shown.includes(id) && !(view.hidden ?? []).includes(id));
  return {
    view: {
      axis: view.axis ?? "distance",
      baseline: view.baseline ?? run?.comparison?.baseline ?? "passive",
      hidden: computed.filter((id) => !strategies.includes(id)),
      zoom: readZoom(view.zoom),
      reference: view.reference ? pinReference(view.reference) : "baseline",
      differences: view.differences ?? false,
      instant: view.instant ?? null,
      requirements,
    },
    strategies,
    at: view.cursor ?? null,
  };
}

/** A link says `null` for the whole run; left out, it is as the page opens. */
function readZoom(zoom: SharedView["zoom"]): ViewZoom {
  if (zoom === undefined) return null;
  const [low, high] = zoom ?? [];
  return low !== undefined && high !== undefined && low < high ? [low, high] : "whole";
}

/** The state before the last edit is this page's alone: neither it nor differences to it are shared. */
function comparisonToShare({
  reference,
  before,
  differences,
}: ResultView): Pick<SharedView, "reference" | "differences"> {
  if (reference === null) return differences ? { differences: true } : {};
  const { runId } = reference.shown;
  return reference === before || runId === null ? {} : { reference: runId, ...(differences && { differences: true }) };
}

export function viewToShare(resultView: ResultView, at: number | null, instant: View["instant"]): SharedView {
  const { summaries, ids, baseline, axis, zoom, whole, range, pins } = resultView;
  const computed = Object.keys(summaries);
  return {
    strategies: computed,
    hidden: computed.filter((id) => !ids.includes(id)),
    ...(baseline === null ? {} : { baseline }),
    axis,
    ...(zoom === null && range !== whole ? {} : { zoom: range === whole ? null : [...range] }),
    cursor: at,
    ...(instant && { instant }),
    ...(pins.length > 0
      ? { pins: pins.flatMap(({ name, shown: { runId } }) => (runId === null ? [] : [{ name, run: runId }])) }
      : {}),
    ...comparisonToShare(resultView),
  };
}
