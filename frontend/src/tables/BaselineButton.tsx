/** A strategy's name in a table; a click compares everything with it. */

import type { Strategy } from "../api/types";
import { useDesk } from "../state/context";
import { StrategyKey } from "./StrategyKey";
import classes from "./tables.module.css";

interface Props {
  readonly strategy: Strategy;
  readonly isBaseline: boolean;
  /** For a column's head: name under its line. */
  readonly upright?: boolean;
}

export function BaselineButton({ strategy, isBaseline, upright = false }: Props) {
  const { lab } = useDesk();
  return (
    <button
      type="button"
      className={classes.baselineButton}
      data-upright={upright || undefined}
      aria-pressed={isBaseline}
      title={isBaseline ? "Changes are against this one" : `Compare with ${strategy.label}`}
      onClick={() => lab.setBaseline(strategy.id)}
    >
      <StrategyKey strategy={strategy} />
      <span>
        {strategy.label}
        <span className={classes.baselineTag} data-on={isBaseline || undefined}>
          {isBaseline ? "baseline" : "compare"}
        </span>
      </span>
    </button>
  );
}
