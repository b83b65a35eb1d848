/** The strategies that are switched on, and how one is switched. */

import type { Strategy, StrategyId } from "../../api/types";
import { useLabContext, useLab } from "../../lab/context";

export function useSelected(strategies: readonly Strategy[]) {
  const { lab } = useLabContext();
  const selected = useLab((state) => state.strategies);
  const toggle = (id: StrategyId) =>
    lab.setStrategies(strategies.map((each) => each.id).filter((other) => selected.includes(other) !== (other === id)));
  return { selected, toggle };
}
