/** A strategy's marker: the same on every plot, canvas and key, whichever other strategies are there. */

import type { Strategy, StrategyId } from "../api/types";

/** Apart without their colour too; plotly's names. */
const SYMBOLS = [
  "circle",
  "diamond",
  "square",
  "triangle-down",
  "pentagon",
  "hourglass",
  "triangle-up",
  "cross",
  "x",
] as const;

export type MarkerSymbol = (typeof SYMBOLS)[number];
export type Markers = Readonly<Record<StrategyId, MarkerSymbol>>;

type Corner = readonly [number, number];

/** `all` are the server's strategies, not only those of one sweep. */
export function markersOf(all: readonly Pick<Strategy, "id">[]): Markers {
  return Object.fromEntries(all.map(({ id }, index) => [id, SYMBOLS[index % SYMBOLS.length] ?? SYMBOLS[0]]));
}

const [ARM, REACH] = [0.42, 1.2];
const CROSS: readonly Corner[] = [
  [-ARM, -REACH],
  [ARM, -REACH],
  [ARM, -ARM],
  [REACH, -ARM],
  [REACH, ARM],
  [ARM, ARM],
  [ARM, REACH],
  [-ARM, REACH],
  [-ARM, ARM],
  [-REACH, ARM],
  [-REACH, -ARM],
  [-ARM, -ARM],
];
const CORNERS: Readonly<Record<Exclude<MarkerSymbol, "circle">, readonly Corner[]>> = {
  diamond: [
    [0, -1.3],
    [1.3, 0],
    [0, 1.3],
    [-1.3, 0],
  ],
  square: [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ],
  "triangle-up": [
    [0, -1.2],
    [1.2, 0.85],
    [-1.2, 0.85],
  ],
  "triangle-down": [
    [0, 1.2],
    [-1.2, -0.85],
    [1.2, -0.85],
  ],
  pentagon: [
    [0, -1.15],
    [1.1, -0.36],
    [0.68, 0.93],
    [-0.68, 0.93],
    [-1.1, -0.36],
  ],
  hourglass: [
    [-1, -1],
    [1, -1],
    [-1, 1],
    [1, 1],
  ],
  cross: CROSS,
  x: CROSS.map(([x, y]): Corner => [(x - y) * Math.SQRT1_2, (x + y) * Math.SQRT1_2]),
};

/** Its outline around the origin as an SVG path; `size` is the radius of a circle. */
export function outlineOf(symbol: MarkerSymbol, size: number): string {
  if (symbol === "circle") return `M${size},0A${size},${size} 0 1 1 ${-size},0A${size},${size} 0 1 1 ${size},0Z`;
  return `M${CORNERS[symbol].map(([x, y]) => `${(x * size).toFixed(2)},${(y * size).toFixed(2)}`).join("L")}Z`;
}
