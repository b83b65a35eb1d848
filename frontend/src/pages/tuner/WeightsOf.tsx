/** A set of weights: a row a stage, the paper's in small beside each that differs. */

import type { Weights } from "../../api/types";
import { dotted } from "../../scenario/fields";
import { DataTable, type Column } from "../../ui/DataTable";
import ui from "../../ui/ui.module.css";
import { formatValue, singlesIn, weightAt, type Single, type Tunable } from "./space";

interface Props {
  readonly weights: Weights;
  /** The paper's. */
  readonly beside: Weights | undefined;
  readonly tunable: Tunable;
}

interface Row {
  readonly title: string;
  readonly items: readonly Pick<Single, "name" | "field">[];
}

export function WeightsOf({ weights, beside, tunable }: Props) {
  const { triples } = tunable;
  const rows: readonly Row[] = [
    ...triples.map(({ title, items }) => ({
      title,
      items: items.map((field) => ({ name: dotted(field.pointer), field })),
    })),
    ...singlesIn(tunable, weights).map(({ name, title, field }) => ({ title, items: [{ name, field }] })),
  ];
  return (
    <DataTable
      label="Weights"
      attributes={{ "data-dense": true }}
      rows={rows}
      rowKey={({ title }) => title}
      columns={[
        { key: "stage", head: "", text: true, cell: ({ title }) => title },
        ...(triples[0]?.items ?? []).map(({ title }, index): Column<Row> => ({
          key: title,
          head: title,
          attributes({ items }) {
            const item = items[index];
            return item ? { "data-weight": item.name, "data-value": weightAt(weights, item.name) ?? "" } : {};
          },
          cell: ({ items }) => items[index] && <Weight {...items[index]} {...{ weights, beside }} />,
        })),
      ]}
    />
  );
}

function Weight({ name, field, weights, beside }: Row["items"][number] & Pick<Props, "weights" | "beside">) {
  const [value, paper] = [weightAt(weights, name), beside && weightAt(beside, name)];
  return (
    <>
      {value === undefined ? "–" : formatValue(value, field)}
      {paper !== undefined && paper !== value && <s className={ui.under}>{formatValue(paper, field)}</s>}
    </>
  );
}
