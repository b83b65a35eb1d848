/** The one way in which rows are sorted, and what is chosen from is grouped. */

export interface Order {
  readonly column: string;
  readonly descending: boolean;
}

const byText = new Intl.Collator("en", { numeric: true });

function compare(a: unknown, b: unknown): number {
  if (typeof a === "number" && typeof b === "number") return a - b;
  return byText.compare(String(a), String(b));
}

const isMissing = (value: unknown) => value === null || value === undefined;

/** What has no value comes last either way; rows with equal values keep their order. */
export function inOrder<Row>(rows: readonly Row[], valueOf: (row: Row) => unknown, descending = false): readonly Row[] {
  return rows.toSorted((left, right) => {
    const [a, b] = [valueOf(left), valueOf(right)];
    if (isMissing(a) || isMissing(b)) return Number(isMissing(a)) - Number(isMissing(b));
    return descending ? compare(b, a) : compare(a, b);
  });
}

/** Options by group. */
export const grouped = <Item>(
  all: readonly Item[],
  groupOf: (item: Item) => string,
  option: (item: Item) => { readonly value: string; readonly label: string },
) =>
  [...new Set(all.map(groupOf))].map((group) => ({
    group,
    items: all.filter((item) => groupOf(item) === group).map(option),
  }));
