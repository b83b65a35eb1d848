/** The row over a table's figures that says which statistic over which window they are. */

import tables from "./tables.module.css";
import type { Words } from "./words";

interface Props {
  /** How many columns stand before the figures. */
  readonly before: number;
  /** In the table's order, those of a window together. */
  readonly metrics: readonly { readonly window: string; readonly statistic: string }[];
  readonly words: Words;
}

export function WindowHeads({ before, metrics, words }: Props) {
  const titles = metrics.map((metric) => words.view(metric));
  return (
    <tr>
      <td colSpan={before} />
      {[...new Set(titles)].map((title) => (
        <th key={title} scope="colgroup" colSpan={titles.filter((each) => each === title).length} className={tables.windowHead}>
          {title}
        </th>
      ))}
    </tr>
  );
}
