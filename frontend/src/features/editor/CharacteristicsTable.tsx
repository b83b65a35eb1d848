/** What a vehicle's values come to: sag, natural frequencies and damping ratios, in the words of a data sheet. */

import type { Characteristics } from "../../api/types";
import { DataTable } from "../../ui/DataTable";
import { formatFixed, formatResult } from "../../units/format";

interface Props {
  readonly of: Characteristics;
  /** Of the stops [m]; `null` where there are none, left out where it is not asked about. */
  readonly clearance?: number | null;
}

const mm = (metres: number) => formatFixed(1000 * metres, 0);

export function CharacteristicsTable({ of, clearance }: Props) {
  const { static_sag: sag, natural_frequencies: frequency, damping_ratios: ratio } = of;
  const travel = typeof clearance === "number" ? `${mm(clearance)} mm` : "no stops";
  const mode = (axle: "front" | "rear", part: "body" | "wheel") =>
    `${formatResult(frequency[`${axle}_${part}`])} Hz, ζ ${formatFixed(ratio[`${axle}_${part}`], 2)}`;
  const rows: readonly (readonly [name: string, front: string, rear: string])[] = [
    ["Static sag", `${mm(sag.front)} mm`, `${mm(sag.rear)} mm`],
    ...(clearance === undefined ? [] : [["Travel to the stops (believed car)", travel, travel] as const]),
    ["Natural frequency, body", mode("front", "body"), mode("rear", "body")],
    ["Natural frequency, wheel", mode("front", "wheel"), mode("rear", "wheel")],
  ];
  return (
    <DataTable
      label="What the vehicle’s values come to"
      attributes={{ "data-dense": true, style: { fontSize: "var(--mantine-font-size-xs)" } }}
      rows={rows}
      rowKey={([name]) => name}
      columns={[
        { key: "name", head: "", text: true, cell: ([name]) => name },
        { key: "front", head: "Front", cell: ([, front]) => front },
        { key: "rear", head: "Rear", cell: ([, , rear]) => rear },
      ]}
    />
  );
}
