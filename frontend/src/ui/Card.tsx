/** A part of a page on a surface of its own. */

import { Box, type BoxProps } from "@mantine/core";
import type { ComponentProps, ReactNode } from "react";
import ui from "./ui.module.css";

interface Props extends Omit<BoxProps, "className">, Omit<ComponentProps<"section">, "title" | keyof BoxProps> {
  readonly "aria-label": string;
  readonly className?: string | undefined;
  readonly title?: ReactNode;
  /** What stands beside the title. */
  readonly tools?: ReactNode;
}

export function Card({ title, tools, className = "", children, ...rest }: Props) {
  return (
    <Box component="section" className={`${ui.card} ${className}`} {...rest}>
      {title !== undefined && (
        <header className={ui.head}>
          <h2 className={ui.heading}>{title}</h2>
          {tools}
        </header>
      )}
      {children}
    </Box>
  );
}
