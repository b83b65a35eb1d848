/** A part of a page on a surface of its own. */

import { Box, Button, Group, type BoxProps } from "@mantine/core";
import { CatchBoundary, type ErrorComponentProps } from "@tanstack/react-router";
import type { ComponentProps, ReactNode } from "react";
import { messageOf } from "../api/problem";
import { Fault } from "./Messages";
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
        <Group component="header" gap="0.4rem 1rem" mih="2.7rem" p="0.4rem 0.9rem">
          <h2 className={ui.heading}>{title}</h2>
          {tools}
        </Group>
      )}
      <CatchBoundary getResetKey={() => "card"} errorComponent={CardFailed}>
        {children}
      </CatchBoundary>
    </Box>
  );
}

interface ColumnsProps extends BoxProps, Omit<ComponentProps<"div">, keyof BoxProps> {
  /** The least width of each. */
  readonly least?: string;
  readonly gap?: string;
}

/** Cards or fields side by side, as many as have room. */
export const Columns = ({ least = "27rem", gap = "0.7rem", className = "", ...rest }: ColumnsProps) => (
  <Box className={`${ui.columns} ${className}`} style={{ gap }} __vars={{ "--least": least }} {...rest} />
);

/** A fault in one card leaves the others. */
function CardFailed({ error, reset }: ErrorComponentProps) {
  return (
    <Fault className={ui.note ?? ""}>
      This part could not be shown: {messageOf(error)}{" "}
      <Button size="compact-xs" variant="light" onClick={reset}>
        Try again
      </Button>
    </Fault>
  );
}
