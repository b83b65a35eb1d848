/** The sets of one variable as curves; the selected one's points are dragged, or typed. */

import { Button, Group, TextInput } from "@mantine/core";
import { useState } from "react";
import type { FieldError as Refused } from "../../api/problem";
import type { FuzzySet, FuzzyVariable } from "../../api/types";
import { useEdit, useReadOnly } from "../../lab/context";
import { EditableCurves } from "../../plots/EditableCurves";
import { child } from "../../scenario/path";
import { formatExact } from "../../units/format";
import { FieldError } from "../editor/FieldFrame";
import { setPointer, TITLES, withNewSet, withSet, type Rewritten, type RuleBase, type Variable } from "./ruleBase";
import { Choice } from "../../ui/Entry";
import { Columns } from "../../ui/Card";
import { PartEntry } from "../editor/NumberFieldRow";

interface Props {
  readonly variable: Variable;
  readonly base: RuleBase;
  /** As the service draws it. */
  readonly drawn: FuzzyVariable;
  readonly errors: readonly Refused[];
  readonly rewritten: Rewritten;
}

/** No two places are nearer to each other than this part of the universe, where they must not coincide. */
const NEAREST = 1e-3;
const FARTHEST = 10_000;

export function SetsEditor({ variable, base, drawn, errors, rewritten }: Props) {
  const [edit, readOnly] = [useEdit(), useReadOnly()];
  const [picked, setPicked] = useState(0);
  const sets = base[variable];
  const selected = Math.min(picked, sets.length - 1);
  const set = sets[selected];
  const end = drawn.universe.at(-1) ?? 1;
  if (!set) return null;
  const pointer = setPointer(variable, selected);
  const error = errors.find((each) => each.pointer.startsWith(`/scenario${pointer}`))?.message;
  const places = pointsOf(set);
  const replaced = (next: FuzzySet | null) =>
    rewritten(edit.newest(), (before) => withSet(before, variable, selected, next));
  return (
    <>
      <EditableCurves
        label={`Sets of the ${TITLES[variable].toLowerCase()}`}
        height={150}
        xRange={[0, end]}
        yRange={[0, 1]}
        curves={sets.map(({ name }, index) => ({ name, x: drawn.universe, y: drawn.memberships[index] ?? [] }))}
        points={places.map((place) => ({ ...place, text: formatExact(place.x, drawn.unit) }))}
        onChoose={setPicked}
        onMove={(point, x) => edit.drag(replaced(moved(set, places[point]?.index ?? 0, x, NEAREST * end)))}
        onRelease={() => edit.commit(edit.newest())}
        {...{ selected, readOnly }}
      />
      <Columns least="7.4rem" gap="0.4rem 0.6rem" data-pointer={pointer}>
        <Choice
          label="Set"
          value={selected}
          data={sets.map(({ name }, index) => ({ value: String(index), label: name }))}
          onPick={(value) => setPicked(Number(value))}
        />
        <SetName
          key={`${selected} ${set.name}`}
          name={set.name}
          onRename={(name) => edit.commit(replaced({ ...set, name }))}
        />
        <Choice
          label="Function"
          value={set.function}
          disabled={readOnly}
          data={Object.entries(FUNCTIONS).map(([value, { title }]) => ({ value, label: title }))}
          onPick={(value) =>
            edit.commit(replaced(converted(set, value, drawn.universe, drawn.memberships[selected] ?? [])))
          }
        />
        {argumentsOf(set).map(({ name, at }, index) => (
          <PartEntry
            key={`${selected} ${name}`}
            {...{ name, error }}
            range={[0, end]}
            farthest={FARTHEST}
            pointer={child(child(pointer, "corners"), index)}
            unit={at === undefined ? "1" : drawn.unit}
            value={set.corners[index]}
            written={(value) => replaced(withCorner(set, index, value))}
          />
        ))}
      </Columns>
      <FieldError id={pointer} error={error} />
      {!readOnly && (
        <Group gap="xs">
          <Button
            size="compact-sm"
            onClick={() => {
              edit.commit(rewritten(edit.newest(), (before) => withNewSet(before, variable, end)));
              setPicked(sets.length);
            }}
          >
            Add a set
          </Button>
          <Button size="compact-sm" disabled={sets.length === 1} onClick={() => edit.commit(replaced(null))}>
            Remove {set.name} and its rules
          </Button>
        </Group>
      )}
    </>
  );
}

function SetName({ name, onRename }: { readonly name: string; readonly onRename: (name: string) => void }) {
  const [typed, setTyped] = useState(name);
  const readOnly = useReadOnly();
  const rename = () => {
    if (typed !== name) onRename(typed);
  };
  return (
    <TextInput
      label="Name"
      value={typed}
      maxLength={30}
      disabled={readOnly}
      onChange={(event) => setTyped(event.currentTarget.value)}
      onBlur={rename}
      onKeyDown={(event) => {
        if (event.key === "Enter") rename();
      }}
    />
  );
}

interface Argument {
  readonly name: string;
  /** How far the curve's point there belongs to the set; without it the argument is no place. */
  readonly at?: number;
  /** A width: beside which argument, and on which side of it. */
  readonly beside?: readonly [argument: number, side: 1 | -1];
}

interface MembershipFunction {
  readonly title: string;
  readonly arguments: readonly Argument[];
  /** Its sides may be upright: neighbouring places may coincide. */
  readonly upright?: boolean;
  /** Of a set around a centre that is as wide as this where it holds by half. */
  readonly around: (centre: number, width: number) => readonly number[];
}

const foot = (name: string): Argument => ({ name, at: 0 });
const top = (name: string): Argument => ({ name, at: 1 });
const half = (name: string): Argument => ({ name, at: 0.5 });
/** A Gaussian's width, from its mean to where the curve bends. */
const width = (name: string, mean: number, side: 1 | -1): Argument => ({
  name,
  at: Math.exp(-0.5),
  beside: [mean, side],
});
const TRAPEZOID = [foot("Left foot"), top("Left shoulder"), top("Right shoulder"), foot("Right foot")];
const trapezoid = (c: number, w: number) => [c - 0.75 * w, c - 0.25 * w, c + 0.25 * w, c + 0.75 * w];

export const FUNCTIONS: Readonly<Record<string, MembershipFunction>> = {
  trimf: {
    title: "Triangle",
    arguments: [foot("Left foot"), top("Peak"), foot("Right foot")],
    upright: true,
    around: (c, w) => [c - w, c, c + w],
  },
  trapmf: { title: "Trapezoid", arguments: TRAPEZOID, upright: true, around: trapezoid },
  gaussmf: { title: "Gaussian", arguments: [top("Mean"), width("Width", 0, 1)], around: (c, w) => [c, w / 2.355] },
  gauss2mf: {
    title: "Two Gaussians",
    arguments: [top("Left mean"), width("Left width", 0, -1), top("Right mean"), width("Right width", 2, 1)],
    around: (c, w) => [c - w / 4, w / 4.71, c + w / 4, w / 4.71],
  },
  gbellmf: {
    title: "Bell",
    arguments: [{ ...half("Width"), beside: [2, 1] }, { name: "Slope" }, top("Centre")],
    around: (c, w) => [w / 2, 2, c],
  },
  sigmf: { title: "Sigmoid", arguments: [half("Centre"), { name: "Slope" }], around: (c, w) => [c, 8 / w] },
  smf: { title: "S curve", arguments: [foot("Foot"), top("Ceiling")], around: (c, w) => [c - w, c] },
  zmf: { title: "Z curve", arguments: [top("Ceiling"), foot("Foot")], around: (c, w) => [c, c + w] },
  pimf: { title: "Pi curve", arguments: TRAPEZOID, around: trapezoid },
};

const argumentsOf = (set: FuzzySet): readonly Argument[] => FUNCTIONS[set.function]?.arguments ?? [];

/** The arguments that are places on the curve: which, where, and how far it belongs to the set there. */
export function pointsOf(set: FuzzySet) {
  return argumentsOf(set).flatMap(({ name, at, beside }, index) => {
    const value = set.corners[index] ?? 0;
    const x = beside ? (set.corners[beside[0]] ?? 0) + beside[1] * value : value;
    return at === undefined ? [] : [{ index, name, x, y: at }];
  });
}

/** The set with one argument's place moved: no further than its neighbours, and no nearer than `least` where it must not. */
export function moved(set: FuzzySet, index: number, x: number, least: number): FuzzySet {
  const all = argumentsOf(set);
  const beside = all[index]?.beside;
  const gap = FUNCTIONS[set.function]?.upright ? 0 : least;
  const neighbour = (order: readonly number[]) =>
    order.find((each) => all[each]?.at !== undefined && !all[each].beside);
  const places = set.corners.map((_, each) => each);
  const [before, behind] = [neighbour(places.slice(0, index).reverse()), neighbour(places.slice(index + 1))];
  const room = (other: number | undefined) => (all[other ?? index]?.at === all[index]?.at ? 0 : gap);
  const low = before === undefined ? -Infinity : (set.corners[before] ?? 0) + room(before);
  const high = behind === undefined ? Infinity : (set.corners[behind] ?? 0) - room(behind);
  const value = beside
    ? Math.max(least, beside[1] * (x - (set.corners[beside[0]] ?? 0)))
    : Math.max(low, Math.min(high, x));
  return withCorner(set, index, rounded(value));
}

const withCorner = (set: FuzzySet, index: number, value: number): FuzzySet => ({
  ...set,
  corners: set.corners.map((corner, each) => (each === index ? value : corner)),
});

/** What a drag gives has no more digits than somebody would type. */
const rounded = (value: number) => Number(value.toPrecision(4));

/** The set by another function, about as wide and at the same place, from where its curve is over one half. */
export function converted(set: FuzzySet, name: string, x: readonly number[], y: readonly number[]): FuzzySet {
  const inside = x.filter((_, index) => (y[index] ?? 0) >= 0.5);
  const [low, high] = [inside[0] ?? x[0] ?? 0, inside.at(-1) ?? x.at(-1) ?? 1];
  const least = ((x.at(-1) ?? 1) - (x[0] ?? 0)) / 100;
  const corners = FUNCTIONS[name]?.around((low + high) / 2, Math.max(least, high - low)) ?? set.corners;
  return { ...set, function: name, corners: corners.map(rounded) };
}
