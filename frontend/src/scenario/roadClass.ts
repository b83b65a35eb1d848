/** Road classes of ISO 8608: mean displacement PSD at 0.1 1/m, A to H, each four times rougher than the last. */

export interface RoadClass {
  readonly letter: string;
  /** Gd(n0) [m^3]. */
  readonly roughness: number;
}

const CLASS_A = 16e-6;

export const ROAD_CLASSES: readonly RoadClass[] = Array.from("ABCDEFGH", (letter, index) => ({
  letter,
  roughness: Number((CLASS_A * 4 ** index).toPrecision(12)),
}));

/** The class whose mean this is, if it is one. */
export function exactClass(roughness: number): RoadClass | undefined {
  return ROAD_CLASSES.find((entry) => Math.abs(entry.roughness - roughness) <= 1e-9 * entry.roughness);
}

/** The class a roughness falls into: boundaries are the geometric means of neighbours (ISO 8608, table C.1). */
export function nearestClass(roughness: number): RoadClass | undefined {
  return ROAD_CLASSES.find((entry) => roughness > 0 && roughness < 2 * entry.roughness) ?? ROAD_CLASSES.at(-1);
}
