/** The bands that vehicle people ask for, margins, and modes, by strategy. */

import type { FrequencyAnswer, Strategy } from "../../api/types";
import { DataTable } from "../../ui/DataTable";
import { StrategyName } from "../../ui/StrategyKey";
import { formatFixed, formatNumber, NO_VALUE } from "../../units/format";
import { spectrumOf } from "./figures";
import classes from "./frequency.module.css";

interface Props {
  readonly answer: FrequencyAnswer;
  /** Those that have an answer. */
  readonly strategies: readonly Strategy[];
}

type Result = FrequencyAnswer["strategies"][string];

const name = {
  key: "name",
  head: "Strategy",
  text: true,
  cell: (strategy: Strategy) => <StrategyName strategy={strategy} />,
};
const ofStrategy = ({ id }: Strategy) => id;
const MOST_MODES = 5;
/** Of which a mode hardly swings. */
const OVERDAMPED = 0.999;

export function BandsTable({
  answer,
  strategies,
  signal,
  unit,
}: Props & { readonly signal: string; readonly unit: string }) {
  const key = spectrumOf(signal);
  const passive = answer.strategies.passive?.bands?.[key];
  return (
    <DataTable
      card
      captioned
      label={`RMS on this road by frequency${key === signal ? "" : ", weighted by ISO 2631-1"}`}
      rows={strategies.filter(({ id }) => answer.strategies[id]?.bands)}
      rowKey={ofStrategy}
      empty="No spectrum of this road is known."
      columns={[
        name,
        ...answer.bands.map(([low = 0, high = 0], index) => ({
          key: String(low),
          head: `${String(low)}–${String(high)} Hz`,
          detail: unit,
          cell: ({ id }: Strategy) => {
            const [value, base] = [answer.strategies[id]?.bands?.[key]?.[index], passive?.[index]];
            if (value === undefined) return NO_VALUE;
            const change = base && id !== "passive" ? ` (${formatFixed(100 * (value / base - 1), 0)} %)` : "";
            return `${formatNumber(value)}${change}`;
          },
        })),
      ]}
    />
  );
}

/** Gains as factors; a dash is a margin without bound, or no loop. */
export function MarginsTable({ answer, strategies }: Props) {
  const column = (
    key: string,
    head: string,
    detail: string,
    of: (result: Result) => number | null | undefined,
    digits = 2,
  ) => ({
    key,
    head,
    detail,
    cell: ({ id }: Strategy) => {
      const result = answer.strategies[id];
      const value = result && of(result);
      return value === null || value === undefined ? NO_VALUE : formatFixed(value, digits);
    },
  });
  const degrees = (phase: number | null | undefined) =>
    phase === null || phase === undefined ? phase : (180 / Math.PI) * phase;
  return (
    <DataTable
      card
      captioned
      label="Stability margins and modes"
      rows={strategies.filter(({ id }) => answer.strategies[id]?.modes)}
      rowKey={ofStrategy}
      columns={[
        name,
        column("gain front", "gain front", "×", ({ margins }) => margins?.front.gain),
        column("gain rear", "gain rear", "×", ({ margins }) => margins?.rear.gain),
        column("phase front", "phase front", "°", ({ margins }) => degrees(margins?.front.phase), 0),
        column("phase rear", "phase rear", "°", ({ margins }) => degrees(margins?.rear.phase), 0),
        column("disk", "disk of both", "α", ({ margins }) => margins?.disk),
        {
          key: "modes",
          head: "modes",
          detail: "Hz, damping ratio",
          text: true,
          cell: ({ id }) => <span className={classes.modes}>{modesText(answer.strategies[id]?.modes ?? [])}</span>,
        },
      ]}
    />
  );
}

const modesText = (modes: NonNullable<Result["modes"]>) =>
  modes
    .filter(({ damping_ratio }) => damping_ratio < OVERDAMPED)
    .slice(0, MOST_MODES)
    .map(
      ({ natural_frequency, damping_ratio }) => `${formatNumber(natural_frequency)} (${formatFixed(damping_ratio, 2)})`,
    )
    .join(", ");
