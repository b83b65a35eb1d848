/** Pairs at the same speed plan: what is left of a gain when nobody slows down alone. */

import type { Attribution } from "../api/types";
import { formatPercent } from "../tables/change";
import changes from "../tables/tables.module.css";
import { metricKey } from "./fair";
import { spreadOf, typeset } from "./numbers";
import tables from "./tables.module.css";
import { WindowHeads } from "./WindowHeads";
import type { Words } from "./words";
import { ScrollTable } from "../ui/ScrollTable";

interface Props {
  readonly pairs: Attribution["equal_speed"];
  readonly words: Words;
}

type Change = Attribution["equal_speed"][number]["cells"][number];

export function EqualSpeed({ pairs, words }: Props) {
  const [first] = pairs;
  if (!first) return null;
  return (
    <ScrollTable label="At the same speed" card className={tables.table} data-testid="equal-speed">
      <thead>
        <WindowHeads before={1} metrics={first.cells} words={words} />
        <tr>
          <th scope="col" className={tables.sticky}>
            At the same speed plan
          </th>
          {first.cells.map((cell) => (
            <th key={metricKey(cell)} scope="col" className={tables.number}>
              {words.signal(cell.signal)}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {pairs.map(({ label, cells }) => (
          <tr key={label}>
            <th scope="row" className={tables.sticky} data-wide>
              {typeset(label)}
            </th>
            {cells.map((cell) => (
              <td key={metricKey(cell)} className={tables.number}>
                <Sure cell={cell} />
              </td>
            ))}
          </tr>
        ))}
      </tbody>
    </ScrollTable>
  );
}

/** Better or worse only where the whole interval says so. */
function Sure({ cell: { our_change: change, ci } }: { readonly cell: Change }) {
  const [low = NaN, high = NaN] = ci;
  const verdict = high < 0 ? "better" : low > 0 ? "worse" : "same";
  return (
    <>
      <span className={changes.change} data-verdict={verdict}>
        <span aria-hidden>{verdict === "better" ? "▼" : verdict === "worse" ? "▲" : "≈"}</span> {formatPercent(change)}
        <span className="visually-hidden">, {verdict === "same" ? "no certain difference" : verdict}</span>
      </span>
      <span className={tables.spread}>{spreadOf(change, ci)}</span>
    </>
  );
}
