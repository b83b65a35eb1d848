/** The car's outline, as SVG writes it: of a sedan, or of a van where the scenario's car is as high as one. */

import type { Dimensions } from "./layout";

type Outline = Pick<Dimensions, "wheelbase" | "radius" | "isVan">;

const [TAIL, NOSE] = [-0.78, 0.82];

/** The body's outline from the rear axle (0, 0) to the front one, y down, 1 m = `s` px; its floor is at y = 0. */
export function bodyPath({ wheelbase, radius, isVan }: Outline, s: number): string {
  const point = (x: number, up: number) => `${(x * s).toFixed(1)} ${(-up * s).toFixed(1)}`;
  const arch = radius * 1.22;
  const [nose, hood, roof] = [wheelbase + NOSE, 0.79 * wheelbase, 0.46 * wheelbase];
  const top = isVan
    ? [
        `L ${point(TAIL, 1.3)} Q ${point(TAIL, 1.5)}, ${point(TAIL + 0.25, 1.5)}`,
        `L ${point(wheelbase - 0.1, 1.5)} Q ${point(wheelbase + 0.25, 1.48)}, ${point(wheelbase + 0.42, 0.86)}`,
        `Q ${point(nose, 0.7)}, ${point(nose, 0.3)}`,
      ]
    : [
        `C ${point(TAIL - 0.04, 0.5)}, ${point(TAIL + 0.02, 0.66)}, ${point(TAIL + 0.2, 0.68)}`,
        `L ${point(-0.28, 0.7)}`,
        `C ${point(0.1, 0.98)}, ${point(0.28, 1.12)}, ${point(roof, 1.12)}`,
        `C ${point(roof + 0.45, 1.12)}, ${point(hood - 0.3, 0.84)}, ${point(hood, 0.7)}`,
        `C ${point(wheelbase + 0.2, 0.65)}, ${point(nose - 0.02, 0.56)}, ${point(nose, 0.3)}`,
      ];
  return [
    `M ${point(TAIL, 0.12)}`,
    ...top,
    `L ${point(nose, 0.1)} Q ${point(nose, 0)}, ${point(nose - 0.12, 0)}`,
    `L ${point(wheelbase + arch, 0)} A ${arch * s} ${arch * s} 0 0 0 ${point(wheelbase - arch, 0)}`,
    `L ${point(arch, 0)} A ${arch * s} ${arch * s} 0 0 0 ${point(-arch, 0)}`,
    `L ${point(TAIL + 0.12, 0)} Q ${point(TAIL, 0)}, ${point(TAIL, 0.12)} Z`,
  ].join(" ");
}

export function windowPath({ wheelbase, isVan }: Outline, s: number): string {
  const point = (x: number, up: number) => `${(x * s).toFixed(1)} ${(-up * s).toFixed(1)}`;
  if (isVan)
    return [
      `M ${point(wheelbase - 0.62, 0.86)} V ${(-1.32 * s).toFixed(1)} H ${((wheelbase - 0.1) * s).toFixed(1)}`,
      `Q ${point(wheelbase + 0.12, 1.3)}, ${point(wheelbase + 0.28, 0.86)} Z`,
    ].join(" ");
  const [pillar, roof, hood] = [0.4 * wheelbase, 0.46 * wheelbase, 0.79 * wheelbase];
  return [
    `M ${point(0.02, 0.74)} C ${point(0.2, 0.95)}, ${point(0.35, 1.03)}, ${point(pillar - 0.04, 1.04)} L ${point(pillar - 0.04, 0.74)} Z`,
    `M ${point(pillar + 0.04, 1.04)} L ${point(roof, 1.04)} C ${point(roof + 0.35, 1.03)}, ${point(hood - 0.35, 0.86)}, ${point(hood - 0.12, 0.74)} L ${point(pillar + 0.04, 0.74)} Z`,
  ].join(" ");
}
