/** Who a row or column is: the strategy, at which speed it met the bump, and the caveats of its result. */

import type { Catalogue } from "../../api/types";
import { useLabContext } from "../../lab/context";
import { CaveatMark } from "./CaveatMark";
import { caveatsOf } from "./caveats";
import type { Entry } from "./entries";
import { formatFixed } from "../../units/format";
import { StrategyKey } from "../../ui/StrategyKey";
import classes from "./tables.module.css";

interface Props {
  readonly entry: Entry;
  readonly catalogue: Catalogue;
  /** For a column's head: name under its line. */
  readonly upright?: boolean;
}

export function EntryHead({ entry: { strategy, summary, isBaseline }, catalogue, upright = false }: Props) {
  const { router } = useLabContext();
  const speed = summary?.arrival_speed_kmh;
  return (
    <span className={classes.entryHead} data-upright={upright || undefined}>
      <button
        type="button"
        className={classes.baselineButton}
        aria-pressed={isBaseline}
        title={isBaseline ? "Changes are against this one" : `Compare with ${strategy.label}`}
        onClick={() => router.setView({ baseline: strategy.id, against: "baseline" })}
      >
        <StrategyKey strategy={strategy} />
        {strategy.label}
      </button>
      <span className={classes.entryFacts}>
        <span title="Speed at which the front axle meets the bump">
          {typeof speed === "number" ? `${formatFixed(speed, speed < 99.95 ? 1 : 0)}\u00a0km/h` : "–"}
        </span>
        {isBaseline && <span>baseline</span>}
        <CaveatMark caveats={caveatsOf(summary?.events, catalogue)} />
      </span>
    </span>
  );
}
