/** A strategy's marker as the plot draws it. */

import type { Strategy } from "../../api/types";
import { outlineOf, type MarkerSymbol } from "../../plots/markers";

interface Props {
  readonly strategy: Pick<Strategy, "colour">;
  readonly symbol: MarkerSymbol | undefined;
}

export function MarkerKey({ strategy, symbol = "circle" }: Props) {
  return (
    <svg width="14" height="14" viewBox="-7 -7 14 14" aria-hidden style={{ flex: "none" }} data-marker={symbol}>
      <path d={outlineOf(symbol, 4.4)} fill={strategy.colour} stroke="var(--muted)" strokeWidth="0.75" />
    </svg>
  );
}
