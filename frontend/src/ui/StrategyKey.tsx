/** A strategy's line as the plots draw it: colour and dash. */

import { Box, Button, type ButtonProps } from "@mantine/core";
import type { ComponentProps, ReactNode } from "react";
import type { Strategy } from "../api/types";
import { prettyUnit } from "../units/format";
import ui from "./ui.module.css";

const DASHES: Readonly<Record<string, string>> = {
  solid: "none",
  dash: "6 3.5",
  dot: "1.8 2.6",
  dashdot: "6 2.6 1.8 2.6",
  longdash: "10 3",
  longdashdot: "10 2.6 1.8 2.6",
};

export function StrategyKey({ strategy }: { readonly strategy: Pick<Strategy, "colour" | "dash"> }) {
  return (
    <LineKey
      colour={strategy.colour}
      dash={DASHES[strategy.dash] ?? strategy.dash.replaceAll("px", "").replaceAll(",", " ")}
    />
  );
}

export function StrategyName({ strategy }: { readonly strategy: Pick<Strategy, "colour" | "dash" | "label"> }) {
  return (
    <span className={ui.named}>
      <StrategyKey strategy={strategy} /> {strategy.label}
    </span>
  );
}

interface NameWithUnitProps {
  readonly name: ReactNode;
  readonly unit: string;
}

/** What a row of numbers is, with its unit beside it. */
export const NameWithUnit = ({ name, unit }: NameWithUnitProps) => (
  <>
    {name} <span className={ui.dim}>{prettyUnit(unit)}</span>
  </>
);

interface Props {
  readonly colour?: string;
  readonly width?: number;
  /** As SVG writes it. */
  readonly dash?: string | undefined;
}

/** A line as the plots draw it: colour, width, dash. */
export function LineKey({ colour = "currentColor", width = 2.5, dash = "none" }: Props) {
  return (
    <svg width="24" height="10" viewBox="0 0 24 10" aria-hidden style={{ flex: "none" }}>
      <line x1="1" x2="23" y1="5" y2="5" stroke={colour} strokeWidth={width} strokeDasharray={dash} />
    </svg>
  );
}

interface StrategyChipProps extends ButtonProps, Omit<ComponentProps<"button">, keyof ButtonProps> {
  readonly strategy: Pick<Strategy, "label">;
  /** Its line or its marker. */
  readonly icon: ReactNode;
  readonly pressed: boolean;
}

/** Shows a strategy, or hides it. */
export function StrategyChip({ strategy, icon, pressed, ...props }: StrategyChipProps) {
  return (
    <Button
      h={30}
      px="0.6rem"
      fz="sm"
      radius="xl"
      {...(pressed
        ? { fw: 600, bd: "1px solid var(--faint)" }
        : { fw: 400, c: "dimmed", bg: "transparent", "data-unprinted": true })}
      aria-pressed={pressed}
      leftSection={
        <Box display="flex" opacity={pressed ? 1 : 0.35}>
          {icon}
        </Box>
      }
      {...props}
    >
      {strategy.label}
    </Button>
  );
}
