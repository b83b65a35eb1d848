/** Pairs at the same speed plan: what is left of a gain when nobody slows down alone. */

import type { Attribution } from "../../api/types";
import { formatPercent } from "../../features/tables/change";
import changes from "../../features/tables/tables.module.css";
import { metricKey } from "./fair";
import { spreadOf, typeset } from "./numbers";
import type { Words } from "./labels";
import ui from "../../ui/ui.module.css";
import { DataTable, type Column } from "../../ui/DataTable";

interface Props {
  readonly pairs: Attribution["equal_speed"];
  readonly words: Words;
}

type Pair = Attribution["equal_speed"][number];

type Change = Pair["cells"][number];

export function EqualSpeed({ pairs, words }: Props) {
  const [first] = pairs;
  if (!first) return null;
  return (
    <DataTable
      label="At the same speed"
      card
      attributes={{ "data-testid": "equal-speed" }}
      rows={pairs}
      rowKey={({ label }) => label}
      columns={[
        { key: "pair", head: "At the same speed plan", text: true, cell: ({ label }) => typeset(label) },
        ...first.cells.map((metric, index): Column<Pair> => ({
          key: metricKey(metric),
          group: words.view(metric),
          head: words.signal(metric.signal),
          cell: ({ cells }) => cells[index] && <Sure cell={cells[index]} />,
        })),
      ]}
    />
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
      <span className={ui.under}>{spreadOf(change, ci)}</span>
    </>
  );
}
