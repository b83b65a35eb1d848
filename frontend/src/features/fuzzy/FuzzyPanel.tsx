/** The fuzzy speed controller's sets and rules, edited beside the surface that they come to and the drive over it. */

import { Box, Button, SegmentedControl, Skeleton, useComputedColorScheme } from "@mantine/core";
import { useState, useEffect } from "react";
import { useEdit, useReadOnly, useScenario, useFromScenario } from "../../lab/context";
import type { ResultView } from "../../lab/resultView";
import { Chart, type ChartFigure } from "../../plots/Chart";
import { PALETTES, chartLayout, type Palette } from "../../plots/palettes";
import { sameValue, getAt, numberAt } from "../../scenario/path";
import { Fault, Note } from "../../ui/Messages";
import { SidePanel } from "../../ui/SidePanel";
import {
  ruleBaseOf,
  TITLES,
  VARIABLES,
  withoutRuleBase,
  withRuleBase,
  type Rewritten,
  type RuleBase,
  type Variable,
  conclusions,
  withConclusion,
} from "./ruleBase";
import { SetsEditor } from "./SetsEditor";
import { useQuery } from "@tanstack/react-query";
import { ask } from "../../api/http";
import { ApiProblem, type FieldError } from "../../api/problem";
import type { FuzzyAnswer, JsonValue } from "../../api/types";
import { DataTable } from "../../ui/DataTable";
import { Choice } from "../../ui/Entry";
import { extent } from "../../lib/samples";
import { useLatest } from "../../lib/latest";

interface Props {
  readonly resultView: ResultView;
  readonly onClose: () => void;
}

export function FuzzyPanel({ resultView, onClose }: Props) {
  const inference = useInference();
  const [edit, scenario, readOnly] = [useEdit(), useScenario(), useReadOnly()];
  const isPaper = sameValue(withoutRuleBase(scenario), scenario);
  return (
    <SidePanel
      title="Fuzzy speed controller"
      data-testid="fuzzy"
      onClose={onClose}
      tools={
        !readOnly && (
          <Button
            size="compact-xs"
            variant="subtle"
            disabled={isPaper}
            aria-label="Back to the paper’s Table 1"
            onClick={() => edit.commit(withoutRuleBase(edit.newest()))}
          >
            Paper’s Table 1
          </Button>
        )
      }
    >
      {inference ? <Parts {...{ inference, resultView }} /> : <Skeleton height={420} />}
    </SidePanel>
  );
}

interface PartsProps {
  readonly inference: Inference;
  readonly resultView: ResultView;
}

function Parts({ inference: { answer, paper, errors }, resultView }: PartsProps) {
  const scenario = useScenario();
  const palette = PALETTES[useComputedColorScheme("light")];
  const [part, setPart] = useState<Variable | "rules">("speed_error");
  const base = ruleBaseOf(scenario, paper);
  const rewritten: Rewritten = (before, to) => withRuleBase(before, ruleBaseOf(before, paper), to);
  const drive = driveIn(resultView);
  return (
    <>
      <Chart
        figure={surfaceFigure(answer, drive, palette)}
        height={230}
        label="Braking torque over distance and speed error, and the drive"
      />
      <Note>
        Braking torque as a share of the greatest.{" "}
        {drive ? `The line is the drive of ${drive.label}.` : "No strategy that is shown slows down for the bump."}
      </Note>
      {errors.map(({ pointer, message }) => (
        <Fault key={pointer + message}>
          {placeOf(pointer, base)}
          {message}
        </Fault>
      ))}
      <SegmentedControl
        fullWidth
        aria-label="What is edited"
        value={part}
        data={[...VARIABLES.map((value) => ({ value, label: TITLES[value] })), { value: "rules", label: "Rules" }]}
        onChange={(value) => setPart(VARIABLES.find((variable) => variable === value) ?? "rules")}
      />
      {part === "rules" ? (
        <RulesTable {...{ base, rewritten }} />
      ) : (
        <SetsEditor key={part} variable={part} drawn={answer[part]} {...{ base, rewritten, errors }} />
      )}
    </>
  );
}

/** The set or rule that a pointer of the service leads to, in words. */
function placeOf(pointer: string, base: RuleBase): string {
  const variable = VARIABLES.find((each) => pointer.includes(each === "torque" ? "/output" : `/inputs/${each}`));
  const index = Number(/\d+/.exec(pointer)?.[0] ?? NaN);
  if (variable) return `${TITLES[variable]} ${base[variable][index]?.name ?? ""}: `;
  return pointer.includes("/rules/") ? `Rule ${index + 1}: ` : "";
}

interface RulesTableProps {
  readonly base: RuleBase;
  readonly rewritten: Rewritten;
}

const NO_RULE = "";
const PADDING = { style: { paddingInline: 1 } };
const NARROW = { headAttributes: PADDING, attributes: () => PADDING };
const nameOf = (set: string | null) => set ?? "any";

function RulesTable({ base, rewritten }: RulesTableProps) {
  const [edit, readOnly] = [useEdit(), useReadOnly()];
  const [rows, columns] = [base.distance, base.speed_error].map((sets) => [...sets.map(({ name }) => name), null]);
  const cellOf = (speed_error: string | null) =>
    function RuleCell(distance: string | null) {
      const cell = { speed_error, distance };
      const then = conclusions(base, cell);
      const several = then.length > 1 ? [{ value: "several", label: then.join(", "), disabled: true }] : [];
      if (distance === null && speed_error === null) return null;
      return (
        <Choice
          miw="3.4rem"
          aria-label={`Distance ${nameOf(distance)}, speed error ${nameOf(speed_error)}`}
          disabled={readOnly}
          value={several[0]?.value ?? then[0] ?? NO_RULE}
          data={[{ value: NO_RULE, label: "–" }, ...base.torque.map(({ name }) => name), ...several]}
          onPick={(value) =>
            edit.commit(
              rewritten(edit.newest(), (before) => withConclusion(before, cell, value === NO_RULE ? null : value)),
            )
          }
        />
      );
    };
  return (
    <Box mx="-0.9rem">
      <DataTable
        label="Rules: the torque for each distance and speed error"
        attributes={{ "data-dense": true }}
        rows={rows ?? []}
        rowKey={nameOf}
        columns={[
          { key: "distance", head: "distance ↓ error →", text: true, cell: nameOf },
          ...(columns ?? []).map((name) => ({
            key: nameOf(name),
            head: nameOf(name),
            text: true,
            cell: cellOf(name),
            ...NARROW,
          })),
        ]}
      />
    </Box>
  );
}

interface Inference {
  /** Of the last rule base that was none to refuse. */
  readonly answer: FuzzyAnswer;
  readonly paper: FuzzyAnswer;
  /** What is wrong with the newest. */
  readonly errors: readonly FieldError[];
}

/** `null` until the paper's is there. */
function useInference(): Inference | null {
  const paper = useQuery({
    queryKey: ["fuzzy"],
    queryFn: ({ signal }) => ask("post", "/fuzzy", { body: {} }, signal),
    staleTime: Infinity,
  }).data;
  const fuzzy = useFromScenario((scenario) => getAt(scenario, "/fuzzy"));
  const { answer, error, request } = useLatest((asked: JsonValue, signal) =>
    ask("post", "/fuzzy", { body: { scenario: { fuzzy: asked } } }, signal),
  );
  useEffect(() => request(fuzzy ?? {}), [request, fuzzy]);
  const errors = error instanceof ApiProblem ? error.errors : error ? [{ pointer: "", message: error.message }] : [];
  return paper ? { paper, answer: answer ?? paper, errors } : null;
}

interface Drive {
  readonly label: string;
  /** To the bump [m], and above the target speed [km/h]. */
  readonly distance: readonly number[];
  readonly speedError: readonly number[];
}

const KMH = 3.6;

/** The first strategy that slows down, from where the bump is detected to where it begins. */
function driveIn({ shown, strategies, series }: ResultView): Drive | null {
  const bump = numberAt(shown.scenario, "/road/bump/start", 0);
  const target = numberAt(shown.scenario, "/speed/target_speed_kmh", 0);
  const detected = bump - numberAt(shown.scenario, "/speed/detection_distance", 0);
  for (const { id, label } of strategies) {
    const { position, speed } = series[id] ?? {};
    const [slowest = 0, fastest = 0] = (speed && extent(speed)) ?? [];
    if (!position || !speed || fastest - slowest < 0.1) continue;
    const places = Array.from(position.keys()).filter((at) => {
      const x = position[at] ?? 0;
      return x >= detected && x <= bump;
    });
    const distance = places.map((at) => bump - (position[at] ?? 0));
    return { label, distance, speedError: places.map((at) => KMH * (speed[at] ?? 0) - target) };
  }
  return null;
}

function surfaceFigure(
  { surface, speed_error, distance }: FuzzyAnswer,
  drive: Drive | null,
  palette: Palette,
): ChartFigure {
  const columns = surface.speed_error.map((_, at) => surface.torque.map((row) => row[at] ?? 0));
  const line = { mode: "lines", opacity: 1, hoverinfo: "skip", type: "scatter", name: "" } as const;
  const path = { ...line, x: drive?.distance ?? [], y: drive?.speedError ?? [] };
  return {
    data: [
      {
        type: "contour",
        name: "",
        x: surface.distance,
        y: surface.speed_error,
        z: columns,
        zmin: 0,
        zmax: 1,
        autocontour: false,
        contours: { start: 0.1, end: 0.9, size: 0.1, coloring: "heatmap" },
        line: { width: 0.6, color: "#ffffff" },
        colorscale: "Cividis",
        colorbar: { thickness: 10, outlinewidth: 0, tickformat: ".0%" },
        hovertemplate: "%{x:.0f} m, %{y:.0f} km/h: %{z:.0%}<extra></extra>",
      },
      // A light line below a dark one is seen on every colour.
      { ...path, line: { width: 5, color: "#ffffff" } },
      { ...path, line: { width: 2, color: "#101418" } },
    ],
    layout: chartLayout(palette, {
      margin: { l: 44, r: 8, t: 12, b: 40 },
      xaxis: { title: { text: `Distance to the bump [${distance.unit}]` }, range: [distance.universe.at(-1), 0] },
      yaxis: { title: { text: `Speed error [${speed_error.unit}]` }, range: [0, speed_error.universe.at(-1)] },
    }),
  };
}
