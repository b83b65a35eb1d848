/** A file of the icons' package. */
declare module "@tabler/icons-react/dist/esm/icons/*.mjs" {
  import type { ComponentType, SVGProps } from "react";

  interface IconProps extends Omit<SVGProps<SVGSVGElement>, "stroke"> {
    /** Width and height [px]. */
    readonly size?: number;
    /** Width of its lines. */
    readonly stroke?: number;
  }
  const icon: ComponentType<IconProps>;
  export default icon;
}
