/** The rules the verdicts follow, and what is printed in the paper but read otherwise here. */

import type { Paper } from "../../api/types";
import { Inline } from "./Inline";
import classes from "./paper.module.css";
import { VerdictMark } from "./Verdict";
import { VERDICTS } from "./verdicts";
import { DataTable } from "../../ui/DataTable";

/** What the other rules are about. */
const ABOUT: Readonly<Record<string, string>> = {
  hil: "Hardware in the loop",
  mean: "Ours",
  ci: "Interval",
  certain: "Certain",
  misprint: "Misprint",
};

export function Rules({ rules }: Pick<Paper, "rules">) {
  const of = (key: string) => VERDICTS.find(({ verdict }) => verdict === key)?.verdict;
  return (
    <dl className={classes.rules}>
      {Object.entries(rules).map(([key, rule]) => {
        const verdict = of(key);
        return (
          <div key={key}>
            <dt>{verdict ? <VerdictMark verdict={verdict} certain /> : (ABOUT[key] ?? key)}</dt>
            <dd>
              <Inline text={rule} />
            </dd>
          </div>
        );
      })}
    </dl>
  );
}

export function Errata({ errata }: Pick<Paper, "errata">) {
  return (
    <DataTable
      label="What is printed, what is used here"
      card
      attributes={{ "data-testid": "errata" }}
      rows={errata}
      rowKey={({ place, printed }) => `${place} ${printed}`}
      columns={(["place", "printed", "here"] as const).map((key) => ({
        key,
        head: { place: "Place", printed: "Printed", here: "Here" }[key],
        text: true,
        headAttributes: { style: { minWidth: "14rem" } },
        cell: (erratum: Paper["errata"][number]) => <Inline text={erratum[key]} />,
      }))}
    />
  );
}
