/** A column for each strategy of each variant, under the variants' names where there are several. */

import type { ReactNode } from "react";
import type { Column } from "../../ui/DataTable";
import { CURRENT, type Entry, type EntryGroup } from "./entries";

type Parts<Row> = Omit<Column<Row>, "key" | "group" | "head" | "text">;

export function variantColumns<Row>(
  groups: readonly EntryGroup[],
  headOf: (entry: Entry) => ReactNode,
  partsOf: (entry: Entry) => Parts<Row>,
): readonly Column<Row>[] {
  return groups.flatMap(({ name, entries }) => {
    // Each an element of its own: variants of the same name stay two.
    const group = groups.length > 1 ? <>{name ?? CURRENT}</> : undefined;
    return entries.map((entry) => ({ ...partsOf(entry), key: entry.key, group, head: headOf(entry) }));
  });
}
