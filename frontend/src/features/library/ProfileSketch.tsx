/** A road's heights over its length, or another curve, in small. */

import { useElementSize } from "@mantine/hooks";
import { Box } from "@mantine/core";
import { formatNumber } from "../../units/format";

interface Props {
  readonly label: string;
  /** In `unit`. */
  readonly distance: readonly number[];
  /** Of each track [m]. */
  readonly tracks: readonly (readonly number[])[];
  /** Stretches to mark, the one that counts in full. */
  readonly marks?: readonly { readonly start: number; readonly width: number; readonly counts: boolean }[];
  /** What is said of the lowest and the highest value. */
  readonly caption?: (low: number, high: number) => string;
  readonly unit?: string;
}

const [HEIGHT, FOOT, HEAD] = [84, 16, 14];
export const SKETCH = {
  display: "block",
  marginTop: "0.4rem",
  fill: "var(--muted)",
  fontSize: "var(--mantine-font-size-xs)",
};
/** No more points than can be seen. */
const MOST = 800;

const heightRange = (low: number, high: number) =>
  `${formatNumber(1000 * (high - low))} mm from the lowest to the highest`;

export function ProfileSketch({ label, distance, tracks, marks = [], caption = heightRange, unit = "m" }: Props) {
  const { ref, width } = useElementSize<HTMLDivElement>();
  const step = Math.max(1, Math.ceil(distance.length / MOST));
  const shown = distance.flatMap((x, index) => (index % step === 0 && Number.isFinite(x) ? [index] : []));
  const heights = tracks.flatMap((track) => shown.map((index) => track[index] ?? NaN)).filter(Number.isFinite);
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  const [from, to] = [distance[shown[0] ?? 0] ?? 0, distance[shown.at(-1) ?? 0] ?? 1];
  const x = (place: number) => ((place - from) / (to - from || 1)) * width;
  const y = (z: number) => HEIGHT - FOOT - ((z - low) / (high - low || 1)) * (HEIGHT - FOOT - HEAD);
  const path = (track: readonly number[]) =>
    shown
      .filter((index) => Number.isFinite(track[index]))
      .map((index) => `${x(distance[index] ?? 0).toFixed(1)},${y(track[index] ?? low).toFixed(1)}`)
      .join(" ");
  return (
    <Box ref={ref} mih={HEIGHT}>
      {width > 0 && heights.length > 1 && (
        <svg width={width} height={HEIGHT} style={SKETCH} role="img" aria-label={label}>
          {marks.map((mark) => (
            <rect
              key={mark.start}
              {...(mark.counts ? { fill: "var(--accent-soft)", stroke: "var(--accent)" } : { fill: "var(--line)" })}
              x={x(mark.start)}
              width={Math.max(3, x(mark.start + mark.width) - x(mark.start))}
              y={HEAD}
              height={HEIGHT - FOOT - HEAD}
            />
          ))}
          {tracks.map((track, index) => (
            <polyline
              key={index}
              points={path(track)}
              fill="none"
              stroke={index === 1 ? "var(--accent)" : "var(--text)"}
              strokeWidth={1.2}
            />
          ))}
          <text x={0} y={10}>
            {caption(low, high)}
          </text>
          <text x={0} y={HEIGHT - 3}>
            {formatNumber(from)} {unit}
          </text>
          <text x={width} y={HEIGHT - 3} textAnchor="end">
            {formatNumber(to)} {unit}
          </text>
        </svg>
      )}
    </Box>
  );
}
