/** How rough a measured road is: its smoothed PSD over the classes of ISO 8608, and the indices in words. */

import { Box } from "@mantine/core";
import { useElementSize } from "@mantine/hooks";
import type { MeasuredRoad } from "../../api/types";
import { formatNumber } from "../../units/format";
import classes from "./library.module.css";

type Analysis = Pick<MeasuredRoad, "iri" | "iso_class" | "roughness" | "waviness" | "spectrum">;

/** The classes' first limit, of A and B at 0.1 1/m [m³]; each further one is four times as high. */
const FIRST_LIMIT = 32e-6;
const CLASSES = ["A", "B", "C", "D", "E", "F", "G", "H"] as const;
const [LOW, HIGH] = [0.011, 2.83];
const [HEIGHT, FOOT] = [150, 16];

const range = ({ low, high }: { readonly low: number; readonly high: number }, scale = 1) =>
  `${formatNumber(scale * low)} to ${formatNumber(scale * high)}`;

/** `null` where nothing is known of it. */
export function indicesText({ iri, iso_class, roughness, waviness }: Analysis): string | null {
  if (!iri) return null;
  const [left, right] = iri.tracks.map((each) => formatNumber(each));
  const index = `IRI ${formatNumber(iri.mean)} m/km${right === undefined ? "" : ` (left ${left}, right ${right})`}.`;
  if (!iso_class || !roughness || !waviness) return index;
  const rough = `${formatNumber(1e6 * roughness.value)} (${range(roughness, 1e6)}) × 10⁻⁶ m³`;
  return `${index} ISO 8608 class ${iso_class}: roughness ${rough}, waviness ${formatNumber(waviness.value)} (${range(waviness)}); 95 % intervals in brackets.`;
}

export function RoadSpectrum({ road: { spectrum, roughness, waviness } }: { readonly road: Analysis }) {
  const { ref, width } = useElementSize<HTMLDivElement>();
  if (!spectrum || !roughness || !waviness) return null;
  const line = (level: number, slope: number) => (n: number) => level * (n / 0.1) ** -slope;
  const fit = line(roughness.value, waviness.value);
  const densities = [...spectrum.density, fit(LOW), fit(HIGH)].map(Math.log10);
  const [bottom, top] = [Math.min(...densities) - 0.3, Math.max(...densities) + 0.3];
  const x = (n: number) => (Math.log(n / LOW) / Math.log(HIGH / LOW)) * width;
  const y = (density: number) => ((top - Math.log10(density)) / (top - bottom)) * (HEIGHT - FOOT);
  const points = (of: readonly (readonly [number, number])[]) =>
    of.map(([n, density]) => `${x(n).toFixed(1)},${y(density).toFixed(1)}`).join(" ");
  const straight = (at: (n: number) => number) => points([LOW, HIGH].map((n) => [n, at(n)] as const));
  return (
    <Box ref={ref} className={classes.profile} mih={HEIGHT}>
      {width > 0 && (
        <svg width={width} height={HEIGHT} role="img" aria-label="Displacement PSD over the road classes of ISO 8608">
          <svg width={width} height={HEIGHT - FOOT}>
            {CLASSES.map((name, index) => {
              const limit = line(FIRST_LIMIT * 4 ** index, 2);
              const middle = 0.1 * Math.sqrt((FIRST_LIMIT * 4 ** (index - 0.5)) / 10 ** ((top + bottom) / 2));
              return (
                <g key={name}>
                  {name !== "H" && <polyline points={straight(limit)} className={classes.band} />}
                  <text x={x(middle)} y={(HEIGHT - FOOT) / 2} textAnchor="middle">
                    {middle > 1.1 * LOW && middle < 0.9 * HIGH ? name : ""}
                  </text>
                </g>
              );
            })}
            <polyline points={straight(fit)} className={classes.fit} />
            <polyline
              className={classes.track}
              points={points(spectrum.frequency.map((n, index) => [n, spectrum.density[index] ?? NaN] as const))}
            />
          </svg>
          <text x={width} y={10} textAnchor="end">
            smoothed PSD, classes A to H
          </text>
          {[0.02, 0.1, 1].map((n) => (
            <text key={n} x={x(n)} y={HEIGHT - 3} textAnchor="middle">
              {n === 1 ? "1 cycle/m" : n}
            </text>
          ))}
        </svg>
      )}
    </Box>
  );
}
