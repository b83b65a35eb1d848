/** What addresses carry in their search part, and how the lab is looked at. */

import type { StrategyId } from "../api/types";
import { pinReference, pinnedRunId, type Reference } from "./compare";
import { readRequirements, requirementsText, type Requirement } from "./requirements";

export type Axis = "distance" | "time";

export type Zoom = readonly [number, number];

/** What of the run the plots show: a range of the shared axis, all of it, or with `null` the bump. */
export type ViewZoom = Zoom | "whole" | null;

export interface View {
  readonly axis: Axis;
  readonly baseline: StrategyId;
  readonly hidden: readonly StrategyId[];
  readonly zoom: ViewZoom;
  readonly reference: Reference;
  /** Plots show differences to what changes are against. */
  readonly differences: boolean;
  /** Whose controller is looked at, and where; `null` while none is. */
  readonly instant: InstantPlace | null;
  /** What the strategies are held to. */
  readonly requirements: readonly Requirement[];
}

export interface InstantPlace {
  readonly strategy: StrategyId;
  /** Of the front axle [m]. */
  readonly position: number;
}

export interface Address {
  readonly runId: string | null;
  /** A shared result. How it is looked at is part of what is shared, so the address never carries it. */
  readonly slug: string | null;
  readonly view: View;
  /** The page a result of which was opened here, as an address of its own. */
  readonly from?: string;
}

export const DEFAULT_VIEW: View = {
  axis: "distance",
  baseline: "passive",
  hidden: [],
  zoom: null,
  reference: "baseline",
  differences: false,
  instant: null,
  requirements: [],
};

type Raw = Readonly<Record<string, unknown>>;

/** The search part as it stands in an address: names and texts, without quotes or escaped commas. */
export const parseSearch = (search: string): Raw => Object.fromEntries(new URLSearchParams(search));

export function stringifySearch(search: Raw): string {
  const query = new URLSearchParams(
    Object.entries(search).flatMap(([name, value]) => (typeof value === "string" ? [[name, value]] : [])),
  );
  const text = query.toString().replace(/%(?:2C|7E|2F|3A|3B)/g, decodeURIComponent);
  return text === "" ? "" : `?${text}`;
}

/** Those of the names that the search part has a text for. */
export const pick = <Name extends string>(search: Raw, ...names: readonly Name[]) =>
  Object.fromEntries(
    names.flatMap((name) => (typeof search[name] === "string" && search[name] !== "" ? [[name, search[name]]] : [])),
  ) as Partial<Record<Name, string>>;

const NAMES = ["axis", "baseline", "hide", "zoom", "against", "plots", "instant", "require", "from"] as const;

export type LabSearch = Partial<Record<(typeof NAMES)[number], string>>;

function parseZoom(text: string | undefined): ViewZoom {
  if (text === "whole") return text;
  const match = /^(-?[\d.]+)~(-?[\d.]+)$/.exec(text ?? "");
  const [low, high] = [Number(match?.[1]), Number(match?.[2])];
  return Number.isFinite(low) && Number.isFinite(high) && low < high ? [low, high] : null;
}

function parseInstant(text: string | undefined): InstantPlace | null {
  const match = /^(\w+)~([\d.]+)$/.exec(text ?? "");
  const [strategy, position] = [match?.[1], Number(match?.[2])];
  return strategy !== undefined && Number.isFinite(position) ? { strategy, position } : null;
}

export const listOf = (text: string | undefined): readonly string[] => text?.split(",").filter(Boolean) ?? [];

const RUN = /^[\w-]{22}$/;

/** In an address stand a pin's run, or `before`; nothing is the baseline. */
const parseReference = (text = ""): Reference =>
  text === "before" ? text : RUN.test(text) ? pinReference(text) : "baseline";

export const viewOf = ({ axis, baseline, hide, zoom, against, plots, instant, require }: LabSearch): View => ({
  axis: axis === "time" ? "time" : "distance",
  baseline: baseline ?? DEFAULT_VIEW.baseline,
  hidden: listOf(hide),
  zoom: parseZoom(zoom),
  reference: parseReference(against),
  differences: plots === "differences",
  instant: parseInstant(instant),
  requirements: readRequirements(require),
});

/** Only what is not as usual. */
export const searchOf = (view: View): LabSearch => {
  const { axis, baseline, hidden, zoom, reference, differences, instant, requirements } = view;
  return {
    ...(axis !== DEFAULT_VIEW.axis && { axis }),
    ...(baseline !== DEFAULT_VIEW.baseline && { baseline }),
    ...(hidden.length > 0 && { hide: hidden.join(",") }),
    ...(zoom && { zoom: zoom === "whole" ? zoom : zoom.map((value) => String(Number(value.toFixed(3)))).join("~") }),
    ...(reference !== "baseline" && { against: pinnedRunId(reference) ?? reference }),
    ...(differences && { plots: "differences" }),
    ...(instant && { instant: `${instant.strategy}~${String(Number(instant.position.toFixed(2)))}` }),
    ...(requirements.length > 0 && { require: requirementsText(requirements) }),
  };
};

/** Any lab's search part without what makes no sense. */
export function readLabSearch(raw: Raw): LabSearch {
  const { from, ...view } = pick(raw, ...NAMES);
  return { ...searchOf(viewOf(view)), ...(from !== undefined && PAGE_WITH_RUNS.test(from) && { from }) };
}

/** Pages from which a run can be opened; nothing else is led back to. */
const PAGE_WITH_RUNS = /^\/(b|robustness|tuner)\/[\w-]+(\?|$)|^\/paper(\?|$)/;
