/** An icon; iconShapes.LICENSE says whose shapes they are. */

import shapes from "./iconShapes.json";
import type { SVGProps } from "react";

export type IconName = keyof typeof shapes;

interface Props extends Omit<SVGProps<SVGSVGElement>, "name" | "stroke"> {
  readonly name: IconName;
  /** Width and height [px]. */
  readonly size?: number;
  /** Width of its lines, of 24 across. */
  readonly stroke?: number;
}

/** A path in a square of 24, drawn with lines or filled, in the colour of the text around it, which says what it means. */
export function Icon({ name, size = 24, stroke = 2, ...rest }: Props) {
  const paint = name.endsWith("Filled")
    ? { fill: "currentColor" }
    : { fill: "none", stroke: "currentColor", strokeWidth: stroke };
  return (
    <svg
      viewBox="0 0 24 24"
      width={size}
      height={size}
      strokeLinecap="round"
      strokeLinejoin="round"
      aria-hidden
      {...paint}
      {...rest}
    >
      <path d={shapes[name]} />
    </svg>
  );
}
