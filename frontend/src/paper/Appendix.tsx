/** The rules the verdicts follow, and what is printed in the paper but read otherwise here. */

import type { Paper } from "../api/types";
import { Inline } from "./Inline";
import classes from "./paper.module.css";
import tables from "./tables.module.css";
import { VerdictMark } from "./Verdict";
import { VERDICTS } from "./verdicts";
import { ScrollTable } from "../ui/ScrollTable";

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
    <ScrollTable label="What is printed, what is used here" card className={`${tables.table ?? ""} ${tables.errata ?? ""}`} data-testid="errata">
      <thead>
        <tr>
          {["Place", "Printed", "Here"].map((name) => (
            <th key={name} scope="col">
              {name}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {errata.map(({ place, printed, here }) => (
          <tr key={`${place} ${printed}`}>
            <th scope="row" className={tables.rowName}>
              <Inline text={place} />
            </th>
            <td>
              <Inline text={printed} />
            </td>
            <td>
              <Inline text={here} />
            </td>
          </tr>
        ))}
      </tbody>
    </ScrollTable>
  );
}
