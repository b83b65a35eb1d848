/** scikit-fuzzy's membership functions: what each argument is, and where it stands on the curve. */

import type { FuzzySet } from "../../api/types";

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

export const argumentsOf = (set: FuzzySet): readonly Argument[] => FUNCTIONS[set.function]?.arguments ?? [];

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

export const withCorner = (set: FuzzySet, index: number, value: number): FuzzySet => ({
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
