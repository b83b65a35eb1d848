/** The bump's outline from the road a run has driven: the formulas of its shapes are the simulation's. */

import type { Scenario } from "../../api/types";
import type { Series } from "../../api/decode";
import { covering, valueAt } from "../../lib/samples";
import { getAt } from "../../scenario/path";

export interface BumpSketch {
  /** Distance from where the bump begins [m], and height over the road there [m]. */
  readonly points: readonly (readonly [number, number])[];
  readonly width: number;
  readonly height: number;
  /** How many of the bumps are drawn. */
  readonly drawn: number;
  readonly count: number;
}

/** More of them would be narrower than a line. */
const MOST_DRAWN = 6;
/** What is shown beside the bumps, as a part of their length. */
const MARGIN = 0.3;
/** Fewer samples of a bump are no outline. */
const LEAST_SAMPLES = 12;

/** `null` where no bump is added, or the run's samples are too few to draw one. */
export function bumpSketch(scenario: Scenario, { position, front_road: road }: Series): BumpSketch | null {
  const read = (name: string) => {
    const value = getAt(scenario, `/road/bump/${name}`);
    return typeof value === "number" ? value : 0;
  };
  const [start, width, height, count, spacing] = ["start", "width", "height", "count", "spacing"].map(read) as [
    number,
    number,
    number,
    number,
    number,
  ];
  if (height === 0 || !position || !road) return null;
  const drawn = Math.min(count, MOST_DRAWN);
  const length = (drawn - 1) * spacing + width;
  const [from, to] = covering(position, start - MARGIN * length, start + (1 + MARGIN) * length);
  if (to - from < LEAST_SAMPLES * drawn) return null;
  const ground = valueAt(position, road, start) ?? 0;
  const points = Array.from(
    position.slice(from, to),
    (x, index) => [x - start, (road[from + index] ?? ground) - ground] as const,
  );
  return { points, width, height, drawn, count };
}

/** Of heights; the largest that leaves them lower than `room`. */
export function exaggeration(rise: number, room: number): number {
  return [50, 20, 10, 5, 2].find((factor) => factor * rise <= room) ?? 1;
}
