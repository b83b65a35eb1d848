/** How much of LV's gain each of its parts is, figure by figure: a bar and its numbers. */

import { formatPercent } from "../tables/change";
import { formatFixed } from "../units/format";
import classes from "./parts.module.css";
import tables from "./tables.module.css";
import { PARTS, scaleOf, segmentsOf, type Share } from "./shares";
import type { Words } from "./words";
import { ScrollTable } from "../ui/ScrollTable";

interface Props {
  readonly shares: readonly Share[];
  readonly words: Words;
}

export function ShareBars({ shares, words }: Props) {
  const scale = scaleOf(shares);
  return (
    <ScrollTable label="Shares of LV’s gain" card className={tables.table} data-testid="shares">
      <thead>
        <tr>
          <th scope="col" className={tables.sticky}>
            Figure
          </th>
          <th scope="col" className={tables.number}>
            Whole change
          </th>
          {PARTS.map(({ part, label }) => (
            <th key={part} scope="col" className={tables.number}>
              <span className={classes.partName}>
                <span className={classes.swatch} data-part={part} aria-hidden />
                {label}
              </span>
            </th>
          ))}
          <th scope="col" className={classes.track}>
            <Ends scale={scale} />
          </th>
        </tr>
      </thead>
      <tbody>
        {shares.map((share) => (
          <tr key={`${share.window} ${share.signal}`}>
            <th scope="row" className={tables.sticky} data-line>
              {words.signal(share.signal)} <span className={tables.unit}>{words.view(share)}</span>
            </th>
            <td className={tables.number}>
              <b>{formatPercent(share.total_change)}</b>
            </td>
            {PARTS.map(({ part }) => (
              <td key={part} className={tables.number}>
                {formatFixed(share[part], 0)} %
              </td>
            ))}
            <td className={classes.track}>
              <Bar share={share} scale={scale} />
            </td>
          </tr>
        ))}
      </tbody>
    </ScrollTable>
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
    <div className={classes.bar} role="img" aria-label={text}>
      {segmentsOf(share).map(({ part, from, to }) => (
        <span key={part} className={classes.segment} data-part={part} style={{ left: offsetOf(from, scale), width: `calc(${offsetOf(to, scale)} - ${offsetOf(from, scale)})` }} />
      ))}
      {[0, 100].map((value) => (
        <span key={value} className={classes.line} style={{ left: offsetOf(value, scale) }} />
      ))}
    </div>
  );
}
