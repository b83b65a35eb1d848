/** The paper's eight figures of `lv_hil` against `lv`, and whether each stays within the rule. */

import type { Catalogue, Summary } from "../../api/types";
import { changeAgainst } from "../../features/tables/change";
import { VIEWS } from "../../features/tables/ComparisonTable";

/** A change of at most so much [%] counts as reached: Tables 9 and 10 print +0.6 to +7.6. */
export const RULE_PERCENT = 8;

export interface HilRow {
  readonly key: string;
  readonly signal: string;
  readonly view: (typeof VIEWS)[number];
  readonly lv: number | undefined;
  readonly hil: number | undefined;
  readonly lqr: number | undefined;
  /** Of `lv_hil` against `lv` [%]. */
  readonly change: number | null;
  /** `null` where there is nothing to compare. */
  readonly within: boolean | null;
}

type Summaries = Readonly<Record<string, Summary>>;

export function rowsOf(catalogue: Pick<Catalogue, "paper_signals">, summaries: Summaries): readonly HilRow[] {
  return VIEWS.flatMap((view) =>
    catalogue.paper_signals.map((signal): HilRow => {
      const of = (strategy: string) => summaries[strategy]?.metrics[view.window]?.[signal]?.[view.statistic];
      const [lv, hil, lqr] = [of("lv"), of("lv_hil"), of("lqr")];
      const { percent } = changeAgainst(hil, lv);
      return {
        key: `${view.window}.${signal}.${view.statistic}`,
        signal,
        view,
        lv,
        hil,
        lqr,
        change: percent,
        within: percent === null ? null : Math.abs(percent) <= RULE_PERCENT,
      };
    }),
  );
}
