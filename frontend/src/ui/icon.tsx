/** An icon as a component. */

import type { ComponentType, SVGProps } from "react";

interface IconProps extends Omit<SVGProps<SVGSVGElement>, "stroke"> {
  /** Width and height [px]. */
  readonly size?: number;
  /** Width of its lines, of 24 across. */
  readonly stroke?: number;
}

/** The icon of a path in a square of 24, drawn with lines or filled, in the colour of the text around it. */
export function icon(path: string, { filled = false } = {}): ComponentType<IconProps> {
  const paint = filled ? { fill: "currentColor" } : { fill: "none", stroke: "currentColor" };
  return function Icon({ size = 24, stroke = 2, ...rest }) {
    return (
      <svg
        viewBox="0 0 24 24"
        width={size}
        height={size}
        strokeWidth={filled ? undefined : stroke}
        strokeLinecap="round"
        strokeLinejoin="round"
        {...paint}
        {...rest}
      >
        <path d={path} />
      </svg>
    );
  };
}
