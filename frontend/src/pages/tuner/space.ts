/** What of a strategy can be tuned, as backend/tunings/space.py has it, the points a tuning is about, and what its numbers are called. */

import type { Scenario, Strategy, StrategyId, Tuning, Weights, Trial, Limit, Objective } from "../../api/types";
import { getAt, type Pointer } from "../../scenario/path";
import {
  findMember,
  optionTitle,
  type ChoiceField,
  type Group,
  type NumberField,
  type VectorField,
} from "../../scenario/schema";
import { dotted, pointerOf } from "../../scenario/fields";
import { typedText, valueText } from "../../scenario/limits";
import { titleWithUnit } from "../../units/format";
import { OWN } from "../../scenario/differences";
import type { RunInLab } from "../../ui/openInLab";
import { useMemo } from "react";
import { fullName, type Metric } from "../../server/metrics";
import { useCatalogues, type Catalogues } from "../../server/useCatalogues";

interface Space {
  readonly triples: readonly Pointer[];
  /** What is searched only where somebody asks for it: the weight on the suspension's travel, the horizon, times. */
  readonly others: readonly Pointer[];
  readonly preview: Pointer;
}

const TIMING: readonly Pointer[] = ["/mpc/expected_offset", "/mpc/expected_noise", "/mpc/sample_time"];
const MPC: Pick<Space, "others" | "preview"> = {
  others: ["/mpc/deflection_weight", "/mpc/prediction_horizon", ...TIMING],
  preview: "/mpc/preview",
};

const SPACES: Readonly<Record<StrategyId, Space>> = {
  lv: { triples: ["/mpc/stage_weights/cruise", "/mpc/stage_weights/brake", "/mpc/stage_weights/bump"], ...MPC },
  suspension_only: { triples: ["/mpc/road_weights/rough", "/mpc/road_weights/bump"], ...MPC },
  lqr: {
    triples: ["/lqr/weights"],
    others: ["/lqr/deflection_weight", "/lqr/preview_horizon", ...TIMING],
    preview: "/lqr/preview",
  },
};

/** Of a controller of one's own: its options that are numbers come first. */
const spaceOf = (form: Group, strategy: StrategyId): Space | undefined => {
  const law = findMember(form, `${OWN}${strategy}`);
  if (law?.kind !== "group") return SPACES[strategy];
  const options = law.members.flatMap(({ kind, pointer }) => (kind === "number" ? [pointer] : []));
  return { triples: [], others: [...options, "/mpc/prediction_horizon", ...TIMING], preview: MPC.preview };
};

/** Ours that have weights, and those of one's own that have options. */
export const isTunable = (form: Group, strategy: StrategyId): boolean => spaceOf(form, strategy) !== undefined;

/** Whether a strategy looks at a field of the scenario. */
export const reads = (strategy: Strategy | undefined, name: string): boolean =>
  strategy?.reads.some((each) => name === each || name.startsWith(`${each}.`)) ?? false;

export interface Tunable {
  readonly triples: readonly VectorField[];
  readonly others: readonly NumberField[];
  readonly preview: ChoiceField | null;
  /** Titles of a controller's own options that are no numbers. */
  readonly untuned: readonly string[];
}

export function tunableOf(form: Group, strategy: StrategyId): Tunable {
  const space = spaceOf(form, strategy);
  const member = (pointer: Pointer) => findMember(form, pointer);
  const preview = space && member(space.preview);
  const law = member(`${OWN}${strategy}`);
  return {
    triples: (space?.triples ?? []).flatMap((pointer) => {
      const vector = member(pointer);
      return vector?.kind === "vector" ? [vector] : [];
    }),
    others: (space?.others ?? []).flatMap((pointer) => {
      const field = member(pointer);
      return field?.kind === "number" ? [field] : [];
    }),
    preview: preview?.kind === "choice" ? preview : null,
    untuned: law?.kind === "group" ? law.members.flatMap(({ kind, title }) => (kind === "choice" ? [title] : [])) : [],
  };
}

/** A single number that can be searched. */
export interface TunableNumber {
  /** Dotted name. */
  readonly name: string;
  /** The title of the row it stands in. */
  readonly row: string;
  /** With the limits of a search: by ratio, so from above 0, but for an option of a controller of one's own. */
  readonly field: NumberField;
  /** It is none of a triple. */
  readonly single: boolean;
}

/** The triples' weights first. */
export function numberFields({ triples, others }: Tunable): readonly TunableNumber[] {
  const searched = (field: NumberField): NumberField =>
    field.minimum > 0 || field.pointer.startsWith(OWN) ? field : { ...field, minimum: 0, exclusiveMinimum: true };
  return [
    ...triples.flatMap((triple) =>
      triple.items.map((field) => ({
        name: dotted(field.pointer),
        row: triple.title,
        field: searched(field),
        single: false,
      })),
    ),
    ...others.map((field) => ({
      name: dotted(field.pointer),
      row: titleOf(field),
      field: searched(field),
      single: true,
    })),
  ];
}

const titleOf = ({ title, shown }: NumberField) => titleWithUnit(title, shown.unit);

/** What the first trial is. */
export const firstTrial = ({ source }: Pick<Tuning, "source">) =>
  source === null ? "the paper’s weights" : "the law’s defaults";

/** A single value of a trial: `mpc.stage_weights.bump.0` of `{"mpc.stage_weights.bump": [1, 1, 6]}`. */
export function weightAt(weights: Weights, name: string): number | string | undefined {
  const whole = weights[name];
  if (typeof whole === "number" || typeof whole === "string") return whole;
  const [, triple, index] = /^(.*)\.(\d+)$/.exec(name) ?? [];
  const list = triple === undefined ? undefined : weights[triple];
  return typeof list === "object" ? list[Number(index)] : undefined;
}

/** A value of a trial, as it stands in a table. */
export interface Single {
  readonly name: string;
  readonly title: string;
  /** Null of an option that its law has no more. */
  readonly field: NumberField | ChoiceField | null;
}

/** What a trial has beside its triples: the numbers and the kind of preview that were searched. */
export function singlesIn({ others, preview }: Tunable, weights: Weights): readonly Single[] {
  const all = [
    ...others.map((field) => ({ name: dotted(field.pointer), title: titleOf(field), field })),
    ...(preview ? [{ name: dotted(preview.pointer), title: preview.title, field: preview }] : []),
  ];
  const gone = Object.keys(weights).filter(
    (name) => name.startsWith("own.") && all.every((each) => each.name !== name),
  );
  return [
    ...all.filter(({ name }) => name in weights),
    ...gone.map((name) => ({ name, title: name.replace(/^own\.\w+\./, ""), field: null })),
  ];
}

/** In the field's shown unit, without it. */
export const formatValue = (value: number | string, field: Single["field"]): string =>
  typeof value === "string" ? optionTitle(value) : field?.kind === "number" ? typedText(field, value) : String(value);

/** The scenario's own value, with its unit. */
export const ownText = (scenario: Scenario, { name, field }: TunableNumber): string => {
  const value = getAt(scenario, pointerOf(name)) ?? field.paperValue; // an option that nobody set has its default
  return typeof value === "number" ? valueText(field, value) : "as it is";
};

export interface Point {
  readonly trial: Trial;
  /** `Paper`, `Best: Eq. 16, whole run`, `Balanced`, all that it is. */
  readonly names: readonly string[];
  readonly isPaper: boolean;
}

/** One entry a trial, whatever it is at once; the paper's first. */
export function pointsOf(tuning: Tuning, objectives: readonly ShownNumber[]): readonly Point[] {
  const { paper, own, best, knee } = tuning;
  const roles: readonly (readonly [Trial | null, string])[] = [
    [paper, "paper"],
    [own, "scenario"],
    ...best.map((trial, index) => [trial, `best.${index}`] as const),
    [knee, "knee"],
  ];
  const points = new Map<number, Point>();
  for (const [trial, role] of roles) {
    if (!trial) continue;
    const names = [...(points.get(trial.number)?.names ?? []), roleName(role, objectives, tuning)];
    points.set(trial.number, { trial, names, isPaper: trial.number === paper?.number });
  }
  return [...points.values()];
}

/** What a role of the comparison is called. */
export function roleName(role: string, objectives: readonly ShownNumber[], { source }: Pick<Tuning, "source">): string {
  if (role === "paper") return source === null ? "The paper’s" : "The defaults";
  if (role === "scenario") return "The scenario’s";
  if (role === "knee") return "Balanced";
  const [, index] = /^best\.(\d+)$/.exec(role) ?? [];
  return objectives.length > 1 && index !== undefined ? `Best: ${objectives[Number(index)]?.label ?? ""}` : "Best";
}

/** What a tuning's page gives its cards. */
export interface TuningParts {
  readonly tuning: Tuning;
  readonly objectives: readonly ShownNumber[];
  readonly limits: readonly ShownNumber[];
  readonly tunable: Tunable;
  readonly points: readonly Point[];
  readonly load: RunInLab<Trial>;
}

export interface ShownNumber {
  readonly label: string;
  readonly unit: string;
  /** From SI to `unit`. */
  readonly scale: number;
}

/** An objective or a limit; a plain figure by its key. */
export function shownOf(
  { figure, label, unit }: Pick<Objective | Limit, "figure" | "label" | "unit">,
  figures: readonly Metric[],
): ShownNumber {
  const metric = figures.find(({ key }) => key === figure);
  return metric ? { label: fullName(metric), unit: metric.unit, scale: metric.scale } : { label, unit, scale: 1 };
}

/** A column of the comparison: `objectives.0`, `limits.1`, or a figure's name. */
export function ofKey(
  key: string,
  { objectives, limits }: Pick<Tuning, "objectives" | "limits">,
  figures: readonly Metric[],
): ShownNumber {
  const [, list, index] = /^(objectives|limits)\.(\d+)$/.exec(key) ?? [];
  const named = (list === "objectives" ? objectives : limits)[Number(index)];
  return shownOf(named ?? { figure: key, label: key, unit: "1" }, figures);
}

/** What the tuner's pages need of the server: as figures only those that are numbers. */
export function useNumericCatalogues(): Catalogues {
  const catalogues = useCatalogues();
  return useMemo(
    () => ({ ...catalogues, figures: catalogues.figures.filter(({ key }) => key !== "events.target_reached") }),
    [catalogues],
  );
}
