/** What each part of LV control contributes: the comparisons the paper does not make. */

import { Text, Box } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import type { Choices } from "./choices";
import { FairTable } from "./FairTable";
import { typeset, spreadOf } from "./numbers";
import classes from "./paper.module.css";
import { attributionQuery } from "./queries";
import { Fault, Waiting } from "./Waiting";
import type { Labels } from "../../server/labels";
import type { Attribution } from "../../api/types";
import { formatPercent } from "../../features/tables/change";
import changes from "../../features/tables/tables.module.css";
import { metricKey } from "./fair";
import ui from "../../ui/ui.module.css";
import { DataTable, type Column } from "../../ui/DataTable";
import { formatFixed } from "../../units/format";
import parts from "./parts.module.css";

interface Props {
  readonly choices: Choices;
  readonly words: Labels;
  /** The cells come first. */
  readonly enabled: boolean;
}

const HEIGHT = 1900;

export function Contributions({ choices, words, enabled }: Props) {
  const { data, error, refetch } = useQuery({ ...attributionQuery(choices), enabled });
  if (error && !data) return <Fault message={error.message} onRetry={() => void refetch()} />;
  if (!data)
    return (
      <Waiting
        key={String(enabled)}
        what={
          enabled
            ? "Running every combination of controller, speed, preview and weights"
            : "Waiting for the runs of the tables"
        }
        height={HEIGHT}
      />
    );
  return (
    <>
      <ul className={classes.sentences} data-testid="sentences">
        {data.sentences.map((sentence) => (
          <li key={sentence}>{typeset(sentence)}</li>
        ))}
      </ul>
      <h3 className={classes.subtitle}>Shares of LV’s gain</h3>
      <Text className={ui.lead ?? ""} mb="0.6rem">
        From an MPC with equal weights, without preview, at constant speed to LV control; {data.seeds} roads, Ridelab’s
        readings. The three can be added in six orders; each share is its average over them, of the logarithm of the
        mean (Shapley values), so the three make 100 %. A negative share makes the figure worse.
      </Text>
      <ShareBars shares={data.shares} words={words} />
      <h3 className={classes.subtitle}>Every combination</h3>
      <Text className={ui.lead ?? ""} mb="0.6rem">
        Means over the same {data.seeds} roads. Slowing down helps comfort; the travel time says what it costs.
      </Text>
      <FairTable rows={data.rows} words={words} />
      <h3 className={classes.subtitle}>At equal speed</h3>
      <Text className={ui.lead ?? ""} mb="0.6rem">
        Change of the first against the second, with its 95 % interval: ▼ better, ▲ worse, ≈ where the interval holds
        zero.
      </Text>
      <EqualSpeed pairs={data.equal_speed} words={words} />
    </>
  );
}

interface EqualSpeedProps {
  readonly pairs: Attribution["equal_speed"];
  readonly words: Labels;
}

type Pair = Attribution["equal_speed"][number];

type Change = Pair["cells"][number];

/** Pairs at the same speed plan: what is left of a gain when nobody slows down alone. */
function EqualSpeed({ pairs, words }: EqualSpeedProps) {
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

interface ShareBarsProps {
  readonly shares: readonly Share[];
  readonly words: Labels;
}

function ShareBars({ shares, words }: ShareBarsProps) {
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
              <span className={`${ui.swatch} ${parts.part}`} data-part={part} aria-hidden />
              {label}
            </span>
          ),
          cell: (share) => `${formatFixed(share[part], 0)} %`,
        })),
        {
          key: "bar",
          head: <Ends scale={scale} />,
          headAttributes: { className: parts.track },
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
    <span className={parts.ends}>
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
          className={`${parts.part} ${parts.segment}`}
          data-part={part}
          style={{ left: offsetOf(from, scale), width: `calc(${offsetOf(to, scale)} - ${offsetOf(from, scale)})` }}
        />
      ))}
      {[0, 100].map((value) => (
        <span key={value} className={parts.line} style={{ left: offsetOf(value, scale) }} />
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

type Part = (typeof PARTS)[number]["part"];
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
