/** How much of LV's gain each of its parts is, figure by figure: a bar and its numbers. */

import { Box } from "@mantine/core";
import { formatPercent } from "../../features/tables/change";
import { formatFixed } from "../../units/format";
import classes from "./parts.module.css";
import ui from "../../ui/ui.module.css";
import type { Labels } from "./labels";
import { DataTable, type Column } from "../../ui/DataTable";
import type { Attribution } from "../../api/types";

interface Props {
  readonly shares: readonly Share[];
  readonly words: Labels;
}

export function ShareBars({ shares, words }: Props) {
  const scale = scaleOf(shares);
  return (
    <DataTable
      label="Shares of LV’s gain"
      card
      attributes={{ "data-testid": "shares" }}
      rows={shares}
      rowKey={({ window, signal }) => `${window} ${signal}`}
      columns={[
        {
          key: "figure",
          head: "Figure",
          text: true,
          cell: (share) => (
            <>
              {words.signal(share.signal)} <span className={ui.dim}>{words.view(share)}</span>
            </>
          ),
        },
        { key: "whole", head: "Whole change", cell: ({ total_change: change }) => <b>{formatPercent(change)}</b> },
        ...PARTS.map(({ part, label }): Column<Share> => ({
          key: part,
          head: (
            <span className={ui.named}>
              <span className={classes.swatch} data-part={part} aria-hidden />
              {label}
            </span>
          ),
          cell: (share) => `${formatFixed(share[part], 0)} %`,
        })),
        {
          key: "bar",
          head: <Ends scale={scale} />,
          headAttributes: { className: classes.track },
          cell: (share) => <Bar share={share} scale={scale} />,
        },
      ]}
    />
  );
}

interface Scaled {
  readonly scale: readonly [number, number];
}

const offsetOf = (value: number, [low, high]: Scaled["scale"]) => `${((value - low) / (high - low)) * 100}%`;

function Ends({ scale }: Scaled) {
  return (
    <span className={classes.ends}>
      <span className="visually-hidden">Bar, from </span>
      {[0, 100].map((value) => (
        <span key={value} style={{ left: offsetOf(value, scale) }}>
          {value} %
        </span>
      ))}
    </span>
  );
}

function Bar({ share, scale }: Scaled & { readonly share: Share }) {
  const text = PARTS.map(({ part, label }) => `${label} ${formatFixed(share[part], 0)} %`).join(", ");
  return (
    <Box pos="relative" h="1rem" role="img" aria-label={text}>
      {segmentsOf(share).map(({ part, from, to }) => (
        <span
          key={part}
          className={classes.segment}
          data-part={part}
          style={{ left: offsetOf(from, scale), width: `calc(${offsetOf(to, scale)} - ${offsetOf(from, scale)})` }}
        />
      ))}
      {[0, 100].map((value) => (
        <span key={value} className={classes.line} style={{ left: offsetOf(value, scale) }} />
      ))}
    </Box>
  );
}

/** Where the bars of the three shares begin and end. Shares may be negative or beyond 100 %. Pure. */
const PARTS = [
  { part: "speed", label: "Lower speed" },
  { part: "preview", label: "Preview" },
  { part: "switching", label: "Weight switching" },
] as const;

export type Part = (typeof PARTS)[number]["part"];
export type Share = Attribution["shares"][number];

interface Segment {
  readonly part: Part;
  readonly from: number;
  readonly to: number;
}

/** What adds stacks up to the right of zero, what takes away to the left of it [%]. */
export function segmentsOf(share: Share): readonly Segment[] {
  let [up, down] = [0, 0];
  return PARTS.map(({ part }) => {
    const size = share[part];
    const from = size >= 0 ? up : down;
    if (size >= 0) up += size;
    else down += size;
    return size >= 0 ? { part, from, to: from + size } : { part, from: from + size, to: from };
  });
}

/** One scale for every bar: from the least to the greatest end, 0 and 100 % always in it. */
export function scaleOf(shares: readonly Share[]): readonly [number, number] {
  const ends = shares.flatMap((share) => segmentsOf(share).flatMap(({ from, to }) => [from, to]));
  return [Math.min(0, ...ends), Math.max(100, ...ends)];
}
