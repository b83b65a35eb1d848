/** How much of LV's gain each of its parts is, figure by figure: a bar and its numbers. */

import { Box } from "@mantine/core";
import { formatPercent } from "../../features/tables/change";
import { formatFixed } from "../../units/format";
import classes from "./parts.module.css";
import ui from "../../ui/ui.module.css";
import { PARTS, scaleOf, segmentsOf, type Share } from "./shares";
import type { Words } from "./labels";
import { DataTable, type Column } from "../../ui/DataTable";

interface Props {
  readonly shares: readonly Share[];
  readonly words: Words;
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
