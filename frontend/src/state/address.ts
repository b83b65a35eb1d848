/** The page's address: `/`, `/r/{id}` with how the run is looked at in the query, or a shared result's `/s/{slug}`. */

import type { StrategyId } from "../api/types";

export type Axis = "distance" | "time";

export type Zoom = readonly [number, number];

/** What of the run the plots show: a range of the shared axis, all of it, or with `null` the bump. */
export type ViewZoom = Zoom | "whole" | null;

export interface View {
  readonly axis: Axis;
  readonly baseline: StrategyId;
  readonly hidden: readonly StrategyId[];
  readonly zoom: ViewZoom;
}

export interface Address {
  readonly runId: string | null;
  /** A shared result. How it is looked at is part of what is shared, so the address never carries it. */
  readonly slug: string | null;
  readonly view: View;
}

export const DEFAULT_VIEW: View = { axis: "distance", baseline: "passive", hidden: [], zoom: null };

function parseZoom(text: string | null): ViewZoom {
  if (text === "whole") return text;
  const match = /^(-?[\d.]+)~(-?[\d.]+)$/.exec(text ?? "");
  const [low, high] = [Number(match?.[1]), Number(match?.[2])];
  return Number.isFinite(low) && Number.isFinite(high) && low < high ? [low, high] : null;
}

const SLUG = /^\/s\/([^/]+)\/?$/;
const RUN = /^\/r\/([^/]+)\/?$/;

/** The one variable part of a path, `null` where the path is another one; a broken escape stays as it stands. */
function partOf(pattern: RegExp, pathname: string): string | null {
  const part = pattern.exec(pathname)?.[1];
  if (part === undefined) return null;
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

export function parseAddress(pathname: string, search: string): Address {
  const slug = partOf(SLUG, pathname);
  if (slug !== null) return { runId: null, slug, view: DEFAULT_VIEW };
  const query = new URLSearchParams(search);
  return {
    runId: partOf(RUN, pathname),
    slug: null,
    view: {
      axis: query.get("axis") === "time" ? "time" : "distance",
      baseline: query.get("baseline") ?? DEFAULT_VIEW.baseline,
      hidden: query.get("hide")?.split(",").filter(Boolean) ?? [],
      zoom: parseZoom(query.get("zoom")),
    },
  };
}

export function formatAddress({ runId, slug, view }: Address): string {
  if (slug !== null) return `/s/${encodeURIComponent(slug)}`;
  const query = new URLSearchParams();
  if (view.axis !== DEFAULT_VIEW.axis) query.set("axis", view.axis);
  if (view.baseline !== DEFAULT_VIEW.baseline) query.set("baseline", view.baseline);
  if (view.hidden.length > 0) query.set("hide", view.hidden.join(","));
  if (view.zoom === "whole") query.set("zoom", view.zoom);
  else if (view.zoom) query.set("zoom", view.zoom.map((value) => String(Number(value.toFixed(3)))).join("~"));
  const text = query.toString().replace(/%2C/g, ",").replace(/%7E/g, "~");
  const path = runId === null ? "/" : `/r/${encodeURIComponent(runId)}`;
  return text === "" ? path : `${path}?${text}`;
}
