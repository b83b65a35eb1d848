/** Names of the variants over their columns, where there are several. */

import type { EntryGroup } from "./entries";
import classes from "./tables.module.css";

export function VariantHeads({ groups }: { readonly groups: readonly EntryGroup[] }) {
  if (groups.length < 2) return null;
  return (
    <tr>
      <td />
      {groups.map(({ name, entries }) => (
        <th key={entries[0]?.key ?? name} scope="colgroup" colSpan={entries.length} className={classes.variantHead}>
          {name ?? "Current scenario"}
        </th>
      ))}
    </tr>
  );
}
