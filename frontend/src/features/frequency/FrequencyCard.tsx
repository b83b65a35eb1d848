/** At which frequency does a control win, and how close is its loop to instability: live while a value is dragged. */

import { Group, Stack, Text, useComputedColorScheme } from "@mantine/core";
import { useEffect, useMemo, useState } from "react";
import { ask } from "../../api/http";
import type { FrequencyAnswer, FrequencyRequest, Scenario, Strategy } from "../../api/types";
import { useCatalogue } from "../../server/useCatalogues";
import type { ResultView } from "../../lab/resultView";
import { PALETTES, type Palette } from "../../plots/palettes";
import { SmallFigure } from "../../plots/Surface";
import { Fault, Note } from "../../ui/Messages";
import { prettyUnit, formatFixed, formatNumber, NO_VALUE } from "../../units/format";
import { DataTable } from "../../ui/DataTable";
import { StrategyName } from "../../ui/StrategyKey";
import { Choice } from "../../ui/Entry";
import { Columns } from "../../ui/Card";
import { marked, panelLayout, verticalRange } from "../../plots/figure";
import type { PanelFigure, PlotTrace } from "../../plots/plotly";
import { useLatest } from "../../lib/latest";

type Output = NonNullable<FrequencyRequest["outputs"]>[number];
type Stage = NonNullable<FrequencyRequest["stage"]>;

const OUTPUTS: readonly Output[] = [
  "body_acceleration",
  "pitch_acceleration",
  "front_tyre_load",
  "rear_tyre_load",
  "front_deflection",
  "rear_deflection",
];
const STAGES: readonly Stage[] = ["cruise", "brake", "bump"];

export function FrequencyCard({ resultView }: { readonly resultView: ResultView }) {
  const catalogue = useCatalogue();
  const palette = PALETTES[useComputedColorScheme("light")];
  const [signal, setSignal] = useState<Output>("body_acceleration");
  const [stage, setStage] = useState<Stage>("bump");
  const { shown, strategies, ids } = resultView;
  const { error, request, ...newest } = useLatest((body: FrequencyRequest & { readonly scenario: Scenario }, by) =>
    ask("post", "/frequency", { body }, by),
  );
  const answer = error ? null : newest.answer;
  const { scenario } = shown;
  const names = ids.join(",");
  useEffect(() => {
    const asked = [...new Set([...names.split(","), "passive"])];
    request({ scenario, strategies: asked, stage, outputs: null, frequencies: null });
  }, [request, scenario, names, stage]);
  const entry = (key: string) => catalogue.signals.find((each) => each.key === key);
  const unit = prettyUnit(entry(signal)?.unit ?? "1");
  const figures = useMemo(
    () => (answer ? frequencyFigures(answer, strategies, signal, palette) : []),
    [answer, strategies, signal, palette],
  );
  return (
    <Stack gap="0.7rem" p="0 0.9rem 0.9rem" data-testid="frequencies" aria-busy={answer === null && error === null}>
      <Group gap="0.6rem">
        <Choice
          aria-label="Response from the road to"
          value={signal}
          data={OUTPUTS.map((key) => ({ value: key, label: entry(key)?.label ?? key }))}
          onPick={(value) => setSignal(OUTPUTS.find((key) => key === value) ?? signal)}
        />
        <Choice
          aria-label="Driving stage"
          value={stage}
          data={STAGES.map((key) => ({ value: key, label: `stage ${key}` }))}
          onPick={(value) => setStage(STAGES.find((key) => key === value) ?? stage)}
        />
      </Group>
      <Note>
        From the road’s height at the front axle, per metre, while no limit binds; held forces, actuator lag, estimator,
        ECU delay and preview are inside. Each stage is taken by itself, as if the car stayed in it: between stages
        there is no margin.
      </Note>
      {error && <Fault>{error.message}</Fault>}
      <Columns least="max(27rem, 40%)" gap="0.6rem 1rem">
        {figures.map(({ title, unit: own, figure }) => (
          <SmallFigure
            key={title}
            {...{ title, figure }}
            unit={title === "Gain" || title.startsWith("Spectrum") ? `${own}, 0 is 1 ${spectral(title, unit)}` : own}
            label={`${title} over frequency`}
            height={176}
          />
        ))}
      </Columns>
      {answer && (
        <>
          <BandsTable {...{ answer, strategies, signal, unit }} />
          <MarginsTable {...{ answer, strategies }} />
          {strategies.flatMap(({ id, label }) => {
            const reason = answer.strategies[id]?.reason;
            return reason ? [<Text key={id} size="xs">{`${label}: ${reason}.`}</Text>] : [];
          })}
        </>
      )}
    </Stack>
  );
}

const spectral = (title: string, unit: string) => (title === "Gain" ? `(${unit})/m` : `(${unit})²/Hz`);

interface BandsTableProps {
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

function BandsTable({
  answer,
  strategies,
  signal,
  unit,
}: BandsTableProps & { readonly signal: string; readonly unit: string }) {
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
function MarginsTable({ answer, strategies }: BandsTableProps) {
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
          cell: ({ id }) => (
            <span style={{ whiteSpace: "nowrap" }}>{modesText(answer.strategies[id]?.modes ?? [])}</span>
          ),
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

interface FrequencyFigure {
  readonly title: string;
  readonly unit: string;
  readonly figure: PanelFigure;
}

const PASSIVE = "passive";
const MARKS = [0.5, 1, 2, 5, 10, 20];
const [Y_TICKS, LEAST_DB, LEAST_DEGREES] = [6, 6, 30];
const BAND_FILL = "rgba(120, 135, 142, 0.13)";

const toDecibels = (ratio: number): number => 20 * Math.log10(Math.max(ratio, Number.MIN_VALUE));
const toDegrees = (phase: number): number => (180 / Math.PI) * phase;

type Values = readonly number[] | undefined;

/** The figures of one signal: gain and phase, gain against passive, and the spectrum on the scenario's road. */
export function frequencyFigures(
  { frequency, bands, strategies: results }: FrequencyAnswer,
  strategies: readonly Strategy[],
  signal: string,
  palette: Palette,
): readonly FrequencyFigure[] {
  const across = frequency.map(Math.log10);
  const range = [across[0] ?? 0, across.at(-1) ?? 1] as const;
  const inRange = MARKS.filter((mark) => Math.log10(mark) >= range[0] && Math.log10(mark) <= range[1]);
  const xaxis = {
    range,
    tickvals: inRange.map(Math.log10),
    ticktext: inRange.map((mark, index) => `${String(mark)}${index === inRange.length - 1 ? " Hz" : ""}`),
  };
  const shapes = bands.map(([low = 1, high = 1]) => ({
    ...{ type: "rect", xref: "x", yref: "paper", x0: Math.log10(low), x1: Math.log10(high), y0: 0, y1: 1 },
    ...{ layer: "below", line: { width: 0 }, fillcolor: BAND_FILL },
  }));
  const figure = (valuesOf: (id: string) => Values, least: number): PanelFigure => {
    const data = strategies.flatMap(({ id, colour, dash, label }): readonly PlotTrace[] => {
      const values = valuesOf(id);
      if (!values) return [];
      const line = { color: colour, width: 1.8, dash };
      const [x, y] = [Float32Array.from(across), Float32Array.from(values)];
      return [{ type: "scatter", mode: "lines", name: label, x, y, line }];
    });
    return { data, layout: panelLayout(palette, xaxis, marked(verticalRange(data, [], 0, least), Y_TICKS), shapes) };
  };
  const gain = (id: string): Values => results[id]?.responses?.[signal]?.magnitude;
  const against = gain(PASSIVE);
  return [
    { title: "Gain", unit: "dB", figure: figure((id) => gain(id)?.map(toDecibels), LEAST_DB) },
    {
      title: "Gain against passive",
      unit: "dB",
      figure: figure(
        (id) => against && gain(id)?.map((value, index) => toDecibels(value / (against[index] ?? 1))),
        LEAST_DB,
      ),
    },
    {
      title: "Phase",
      unit: "°",
      figure: figure((id) => results[id]?.responses?.[signal]?.phase.map(toDegrees), LEAST_DEGREES),
    },
    {
      title: "Spectrum on this road",
      unit: "dB",
      figure: figure((id) => results[id]?.psd?.[spectrumOf(signal)]?.map((value) => toDecibels(value) / 2), LEAST_DB),
    },
  ];
}

/** Of body acceleration that which ISO 2631-1 weighs: what people feel. */
const spectrumOf = (signal: string): string => (signal === "body_acceleration" ? "weighted_body_acceleration" : signal);
