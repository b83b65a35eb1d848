/** Which weights of a strategy can be tuned, as backend/tuner/space.py has them; their names and limits are the form's. */

import type { Scenario, StrategyId, Weights } from "../api/types";
import { getAt, setAt, type Pointer } from "../editor/path";
import { findMember, type Group, type NumberField, type VectorField } from "../editor/schema";
import { dotted, pointerOf } from "../sweep/fields";

interface Space {
  readonly triples: readonly Pointer[];
  /** The weight on the suspension's travel, which is searched only where somebody asks for it. */
  readonly travel: Pointer;
}

const SPACES: Readonly<Record<StrategyId, Space>> = {
  lv: { triples: ["/mpc/stage_weights/cruise", "/mpc/stage_weights/brake", "/mpc/stage_weights/bump"], travel: "/mpc/deflection_weight" },
  suspension_only: { triples: ["/mpc/road_weights/rough", "/mpc/road_weights/bump"], travel: "/mpc/deflection_weight" },
  lqr: { triples: ["/lqr/weights"], travel: "/lqr/deflection_weight" },
};

export const TUNABLE: readonly StrategyId[] = Object.keys(SPACES);

export interface Tunable {
  readonly triples: readonly VectorField[];
  readonly travel: NumberField | null;
}

export function tunableOf(form: Group, strategy: StrategyId): Tunable {
  const space = SPACES[strategy];
  const member = (pointer: Pointer) => findMember(form, pointer);
  const travel = space && member(space.travel);
  return {
    triples: (space?.triples ?? []).flatMap((pointer) => {
      const vector = member(pointer);
      return vector?.kind === "vector" ? [vector] : [];
    }),
    travel: travel?.kind === "number" ? travel : null,
  };
}

/** Every single weight by its dotted name, the travel's last. */
export function weightFields({ triples, travel }: Tunable): readonly { readonly name: string; readonly row: string; readonly field: NumberField; readonly travel: boolean }[] {
  return [
    ...triples.flatMap((triple) => triple.items.map((field) => ({ name: dotted(field.pointer), row: triple.title, field, travel: false }))),
    ...(travel ? [{ name: dotted(travel.pointer), row: travel.title, field: travel, travel: true }] : []),
  ];
}

/** The scenario with a trial's weights in it. */
export const withWeights = (scenario: Scenario, weights: Weights): Scenario =>
  Object.entries(weights).reduce((result, [name, value]) => setAt(result, pointerOf(name), value), scenario);

/** A single weight of a trial: `mpc.stage_weights.bump.0` of `{"mpc.stage_weights.bump": [1, 1, 6]}`. */
export function weightAt(weights: Weights, name: string): number | undefined {
  const whole = weights[name];
  if (typeof whole === "number") return whole;
  const [, triple, index] = /^(.*)\.(\d+)$/.exec(name) ?? [];
  const list = triple === undefined ? undefined : weights[triple];
  return typeof list === "object" ? list[Number(index)] : undefined;
}

export const ownWeight = (scenario: Scenario, name: string): number | undefined => {
  const value = getAt(scenario, pointerOf(name));
  return typeof value === "number" ? value : undefined;
};
