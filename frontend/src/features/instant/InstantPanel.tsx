/** Why this force, here: what the controller saw and planned at the cursor, its limits with their price, its cost. */

import { Group, Text, useComputedColorScheme } from "@mantine/core";
import { type InstantAnswer, type StrategyId } from "../../api/types";
import { type InstantPlace, type Axis } from "../../lab/address";
import { useLabContext } from "../../lab/context";
import { cursor } from "../../lab/cursor";
import { type ResultView, axisKey } from "../../lab/resultView";
import { PALETTES, type Palette } from "../../plots/palettes";
import { SmallFigure } from "../../plots/Surface";
import { DataTable } from "../../ui/DataTable";
import { Fault, Note } from "../../ui/Messages";
import { Icon } from "../../ui/icons";
import { IconButton } from "../../ui/IconButton";
import { SidePanel } from "../../ui/SidePanel";
import { LineKey } from "../../ui/StrategyKey";
import { useCopied } from "../../ui/useCopied";
import { formatFixed, formatResult } from "../../units/format";
import ui from "../../ui/ui.module.css";
import { useThrottledCallback } from "@mantine/hooks";
import { useEffect } from "react";
import { humanise } from "../../scenario/schema";
import { ask } from "../../api/http";
import { Choice, labelled } from "../../ui/Entry";
import { useLatest } from "../../lib/latest";
import { extent } from "../../lib/samples";
import { marked, panelLayout, verticalRange } from "../../plots/figure";
import { type PanelFigure, type PlotTrace } from "../../plots/plotly";

interface Props {
  readonly resultView: ResultView;
  readonly strategy: StrategyId;
  readonly placeAt: (x: number) => InstantPlace | null;
}

export function InstantPanel({ resultView, strategy, placeAt }: Props) {
  const { labAddress } = useLabContext();
  const { shown, axis, strategies } = resultView;
  const { answer, fault } = useInstant(shown.runId, strategy, axis);
  const close = () => labAddress.setView({ instant: null });
  const drawn = strategies.find(({ id }) => id === strategy);
  return (
    <SidePanel
      title="Why this force?"
      data-testid="instant"
      onClose={close}
      tools={
        <>
          <Choice
            aria-label="Whose controller"
            value={strategy}
            data={labelled(strategies)}
            onPick={(value) => {
              const place = placeAt(cursor.get(axis) ?? 0);
              if (place) labAddress.setView({ instant: { ...place, strategy: value } });
            }}
          />
          <CopyLink place={() => placeAt(cursor.get(axis) ?? 0)} />
        </>
      }
    >
      {fault !== null && <Fault>{fault}</Fault>}
      {shown.runId === null && <Text size="xs">While a value is dragged this is the instant before.</Text>}
      {answer && drawn && <Seen answer={answer} colour={drawn.colour} seed={shown.over !== null} />}
    </SidePanel>
  );
}

/** Copies the page's address with the instant under the cursor in it. */
function CopyLink({ place }: { readonly place: () => InstantPlace | null }) {
  const { labAddress } = useLabContext();
  const { copied, copy } = useCopied();
  return (
    <IconButton
      label={copied ? "Copied" : "Copy a link to this instant"}
      onClick={() => {
        labAddress.setView({ instant: place() });
        copy(window.location.href);
      }}
    >
      {copied ? <Icon name="Check" size={16} /> : <Icon name="Link" size={16} />}
    </IconButton>
  );
}

interface SeenProps {
  readonly answer: InstantAnswer;
  readonly colour: string;
  /** It is of the first of several roads. */
  readonly seed: boolean;
}

function Seen({ answer, colour, seed }: SeenProps) {
  const palette = PALETTES[useComputedColorScheme("light")];
  const { position, time, speed, stage, why } = answer;
  const place = `${formatFixed(position, 2)} m, ${formatFixed(time, 2)} s, ${formatFixed(3.6 * speed, 1)} km/h, stage ${stage}`;
  return (
    <>
      <Note data-testid="instant-place">
        {place}
        {seed && ", first road"}
      </Note>
      <Text mih="2.8em" fz="sm" fw={500} lh={1.4} data-testid="why">
        {why.replace(/-(?=\d)/g, "−")}
      </Text>
      <Group gap="0.9rem" fz="xs">
        <span className={ui.named}>
          <LineKey colour={colour} /> front
        </span>
        <span className={ui.named}>
          <LineKey colour={colour} dash={REAR_DASH} /> rear
        </span>
      </Group>
      {horizonFigures(answer, colour, palette).map(({ title, unit, figure }) => (
        <SmallFigure
          key={title}
          {...{ title, unit, figure }}
          label={`${title} in ${unit} over the horizon`}
          height={104}
        />
      ))}
      <Forces answer={answer} />
      <Limits answer={answer} />
      <Cost answer={answer} />
    </>
  );
}

const newtons = (force: number | undefined) => (force === undefined ? "–" : formatFixed(force, 0));

/** What was asked for, told and acts; of a law without a plan what each part of its input adds. */
function Forces({ answer: { forces, parts, cost } }: { readonly answer: InstantAnswer }) {
  const rows = [
    ...(forces.asked ? [["Asked for", forces.asked] as const] : []),
    ["Commanded", forces.command] as const,
    ["Before", forces.previous] as const,
    ["Acts", forces.acting] as const,
    ...(cost === null && parts
      ? Object.entries(parts).map(([name, part]) => [`of it: ${humanise(name).toLowerCase()}`, part] as const)
      : []),
  ];
  return (
    <DataTable
      label="Forces"
      rows={rows}
      rowKey={([name]) => name}
      columns={[
        { key: "name", head: "Force", detail: "N", text: true, cell: ([name]) => name },
        { key: "front", head: "front", cell: ([, [front]]) => newtons(front) },
        { key: "rear", head: "rear", cell: ([, [, rear]]) => newtons(rear) },
      ]}
    />
  );
}

type Limit = InstantAnswer["limits"][number];

const price = ({ multiplier, unit }: Limit) =>
  multiplier === null ? "–" : multiplier === 0 ? "0" : `${formatResult(multiplier, 2)} /${unit}`;

function Limits({ answer: { limits } }: { readonly answer: InstantAnswer }) {
  if (limits.length === 0) return null;
  return (
    <DataTable
      label="Limits"
      rows={limits}
      rowKey={({ name }) => name}
      rowAttributes={({ distance }) => ({ "data-strong": distance <= 0 || undefined })}
      columns={[
        { key: "name", head: "Limit", text: true, cell: ({ name }) => limitName(name) },
        {
          key: "distance",
          head: "distance",
          cell: ({ distance, unit }) =>
            unit === "m" ? `${formatFixed(1000 * distance, 1)} mm` : `${formatFixed(distance, 0)} ${unit}`,
        },
        {
          key: "price",
          head: "price",
          help: "By how much the cost falls where the limit is raised by one unit",
          cell: price,
        },
        {
          key: "without",
          head: "forces without",
          detail: "front, rear N",
          cell: ({ force_without: forces }) => (forces === null ? "–" : forces.map(newtons).join(", ")),
        },
      ]}
    />
  );
}

/** Terms below this share of the cost are left out. */
const LEAST_SHARE = 0.005;

function Cost({ answer: { cost } }: { readonly answer: InstantAnswer }) {
  if (cost === null) return null;
  const total = Object.values(cost).reduce((sum, value) => sum + value, 0);
  const shown = Object.entries(cost).filter(([, value]) => value > LEAST_SHARE * total);
  return (
    <DataTable
      label="Cost of the plan by term"
      rows={[...shown].sort(([, a], [, b]) => b - a)}
      rowKey={([name]) => name}
      columns={[
        { key: "name", head: "Cost of the plan", text: true, cell: ([name]) => humanise(name) },
        { key: "cost", head: "cost", cell: ([, value]) => formatResult(value) },
        { key: "share", head: "share", cell: ([, value]) => `${formatFixed((100 * value) / total, 0)} %` },
      ]}
    />
  );
}

const NAMES: Readonly<Record<string, string>> = {
  force: "force",
  deflection: "travel",
  force_change: "force change in a step",
  actuator_force: "actuator’s own force",
};

/** `rear_force_change` → `Rear force change in a step`. */
export function limitName(name: string): string {
  const [, where = "", kind = ""] = /^(front|rear)_(.*)$/.exec(name) ?? [];
  return where === "" ? name : `${where === "front" ? "Front" : "Rear"} ${NAMES[kind] ?? kind.replaceAll("_", " ")}`;
}

/** Between two questions [ms]. */
const PACE_MS = 100;

interface Question {
  readonly id: string;
  readonly of: StrategyId;
  readonly along: Axis;
  readonly at: number;
}

/** `runId` is `null` as a run is a preview, whose instants nobody can ask for. */
function useInstant(runId: string | null, strategy: StrategyId, axis: Axis) {
  const { answer, error, request, cancel } = useLatest(({ id, of, along, at }: Question, signal) =>
    ask("get", "/runs/{id}/instant", { path: { id }, query: { strategy: of, [axisKey(along)]: at } }, signal),
  );
  const follow = useThrottledCallback(() => {
    const at = cursor.get(axis);
    if (runId !== null && at !== null) request({ id: runId, of: strategy, along: axis, at });
  }, PACE_MS);
  useEffect(() => {
    follow();
    const following = cursor.subscribe(follow);
    return () => {
      following.unsubscribe();
      cancel();
    };
  }, [follow, cancel, runId, strategy, axis]);
  return { answer: error ? null : answer, fault: error?.message ?? null };
}

/** Figures of what was planned over the horizon, and of the road ahead. Pure. */
interface HorizonFigure {
  readonly title: string;
  readonly unit: string;
  readonly figure: PanelFigure;
}

/** The rear axle's dash; the front one's line is solid. */
const REAR_DASH = "5,3";
const [X_TICKS, Y_TICKS, ROOM] = [4, 4, 0.04];
const [MILLI, LEAST_FORCE, LEAST_TRAVEL] = [1000, 20, 2];

type Pair = readonly (readonly number[])[];

interface Drawn {
  readonly x: readonly number[];
  readonly y: readonly number[];
  readonly colour: string;
  readonly dash?: string;
  readonly width?: number;
}

const column = (rows: Pair, index: number, scale = 1) => rows.map((row) => (row[index] ?? 0) * scale);

function figureOf(drawn: readonly Drawn[], limit: number | null, least: number, palette: Palette): PanelFigure {
  const data = drawn.map(({ x, y, colour, dash = "", width = 1.8 }): PlotTrace => ({
    type: "scatter",
    mode: "lines",
    x: Float32Array.from(x),
    y: Float32Array.from(y),
    line: { color: colour, width, dash },
  }));
  const references = limit === null ? [] : [-limit, limit];
  const [from, to] = extent(Float32Array.from(drawn.flatMap(({ x }) => x))) ?? [0, 1];
  const range = [from, to + ROOM * (to - from)] as const; // the last mark's unit needs it
  const line = { color: palette.text, width: 1, dash: "dot" };
  const shapes = references.map((y) => ({ type: "line", xref: "paper", yref: "y", x0: 0, x1: 1, y0: y, y1: y, line }));
  const vertical = verticalRange(data, references, 0, least);
  return { data, layout: panelLayout(palette, marked(range, X_TICKS, " s"), marked(vertical, Y_TICKS), shapes) };
}

/** A held value's line: each stands from one instant to the next. */
function held(time: readonly number[], values: readonly number[]): Pick<Drawn, "x" | "y"> {
  return {
    x: values.flatMap((_, index) => [time[index] ?? 0, time[index + 1] ?? 0]),
    y: values.flatMap((value) => [value, value]),
  };
}

/** What there is of an instant to draw, over the seconds from now on. */
export function horizonFigures(instant: InstantAnswer, colour: string, palette: Palette): readonly HorizonFigure[] {
  const { predicted_time: times, predicted_states: states, predicted_forces: forces, preview, limits } = instant;
  const limitOf = (name: string) => limits.find((limit) => limit.name === name)?.limit ?? null;
  const figures: HorizonFigure[] = [];
  const axle = (index: number) => ({ colour, ...(index === 1 && { dash: REAR_DASH }) });
  if (times && states && forces) {
    const time = times.map((each) => each - instant.time);
    const travel = limitOf("front_deflection");
    figures.push({
      title: "Planned suspension travel",
      unit: "mm",
      figure: figureOf(
        [0, 1].map((index) => ({ x: time, y: column(states, index, MILLI), ...axle(index) })),
        travel === null ? null : travel * MILLI,
        LEAST_TRAVEL,
        palette,
      ),
    });
    figures.push({
      title: "Planned forces",
      unit: "N",
      figure: figureOf(
        [0, 1].map((index) => ({ ...held(time, column(forces, index)), ...axle(index) })),
        limitOf("front_force"),
        LEAST_FORCE,
        palette,
      ),
    });
  }
  if (preview) {
    const x = preview.time.map((each) => each - instant.time);
    const road = (rows: Pair, index: number) => ({ x, y: column(rows, index, MILLI), ...axle(index) });
    figures.push({
      title: "Road ahead: as seen, over the real one in grey",
      unit: "mm",
      figure: figureOf(
        [
          ...[0, 1].map((index) => ({ ...road(preview.real, index), colour: palette.zero, width: 4 })),
          ...[0, 1].map((index) => road(preview.seen, index)),
        ],
        null,
        LEAST_TRAVEL,
        palette,
      ),
    });
  }
  return figures;
}
