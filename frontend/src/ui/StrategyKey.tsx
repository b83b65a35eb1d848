/** A strategy's line as the plots draw it: colour and dash. */

import type { Strategy } from "../api/types";
import { LineKey } from "./LineKey";
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
