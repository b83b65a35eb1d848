/** The paper's weights and the tuned ones, on the training and on the validation roads. */

import { Group, Skeleton, Stack, Text } from "@mantine/core";
import type { ReactNode } from "react";
import { Icon, type IconName } from "../../ui/icons";
import type { ComparedPoint, TunedFigure, Tuning, TuningComparison } from "../../api/types";
import { isFinal } from "../../jobs/useJob";
import type { Metric } from "../../server/metrics";
import { formatPercent } from "../../features/tables/change";
import tables from "../../features/tables/tables.module.css";
import { formatResult } from "../../units/format";
import { ofKey, type ShownNumber, roleName, type TuningParts, firstTrial } from "./space";
import { DataTable, type Column } from "../../ui/DataTable";
import { LimitValue } from "./PointsTable";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";
import { Note } from "../../ui/Messages";
import { NameWithUnit } from "../../ui/StrategyKey";
import { ChangeText, SureChange } from "../../features/tables/ChangeMark";

interface Props extends Pick<TuningParts, "tuning" | "objectives"> {
  readonly figures: readonly Metric[];
}

const WARNING = ["AlertTriangle", "var(--worse)"] as const;
const SIGN: Readonly<Record<Keeps, readonly [IconName, string?]>> = {
  keeps: ["Check", "var(--better)"],
  shrinks: WARNING,
  unclear: WARNING,
  worse: WARNING,
  none: ["Equal"],
};

/** What the search has come to: whether each gain holds on roads it has not seen, and what got worse for it. */
export function Conclusion({ tuning, objectives, figures }: Props) {
  const { comparison } = tuning;
  if (!comparison) return null;
  const gains = gainsOf(comparison, objectives.length);
  const nameOf = (key: string) => ofKey(key, tuning, figures).label;
  return (
    <Card aria-label="Conclusion">
      <Stack component="ul" className={ui.list ?? ""} gap="0.3rem" p="0.6rem 0.9rem">
        {gains.map((gain) => (
          <SignedLine key={gain.objective} keeps={gain.keeps}>
            {objectives.length > 1 && <strong>{objectives[gain.objective]?.label}: </strong>}
            {gain.text} {priceText(gain, nameOf)}
          </SignedLine>
        ))}
        {comparison.points.flatMap(({ trial, failures }) =>
          failures.map((failure) => (
            <SignedLine key={`${trial} ${failure}`} keeps="worse">
              Trial {trial} could not be run on every road; left out: {failure}
            </SignedLine>
          )),
        )}
      </Stack>
    </Card>
  );
}

export function ValidationTable({ tuning, objectives, figures }: Props) {
  const { comparison } = tuning;
  if (!comparison) {
    return (
      <Card aria-label="Validation roads" aria-busy={!isFinal(tuning) || undefined} title="Validation roads">
        <div className={ui.note}>
          <Text c="dimmed">
            {isFinal(tuning)
              ? "The comparison is made once the search is complete: resume it for that."
              : `When the search is complete, the best weights drive ${tuning.fresh_seeds.length} roads they were not tuned on, beside ${firstTrial(tuning)}.`}
          </Text>
          {tuning.step === "comparison" && !isFinal(tuning) && <Skeleton height={120} radius={6} mt={10} />}
        </div>
      </Card>
    );
  }
  return (
    <Card
      aria-label="Validation roads"
      title={`Validation: ${tuning.seeds.length} training and ${tuning.fresh_seeds.length} validation roads`}
    >
      <DataTable
        label="The first trial’s and the tuned weights over training and validation roads"
        rows={comparison.figures.map(({ key }) => rowOf(key, tuning, figures))}
        rowKey={({ key }) => key}
        rowAttributes={({ key }) => ({ "data-figure": key })}
        columns={[
          {
            key: "figure",
            head: "",
            text: true,
            cell: ({ label, unit, isLimit }) => (
              <NameWithUnit name={isLimit ? `${label}, largest` : label} unit={unit} />
            ),
          },
          ...comparison.points.flatMap((point) =>
            columnsOf(
              point,
              `${point.roles.map((role) => roleName(role, objectives, tuning)).join(", ")} · trial ${point.trial}`,
            ),
          ),
        ]}
      />
      <Note className={ui.note ?? ""}>
        Means over the roads; the change against {firstTrial(tuning)} with its 95 % interval, paired road by road. An
        arrow stands only where the interval does not hold zero.
      </Note>
    </Card>
  );
}

function SignedLine({ keeps, children }: { readonly keeps: Keeps; readonly children: ReactNode }) {
  const [icon, colour] = SIGN[keeps];
  return (
    <Group component="li" gap="0.45rem" align="flex-start" wrap="nowrap" data-keeps={keeps}>
      <Icon name={icon} size={16} style={{ flex: "none", marginTop: 2, color: colour }} />
      <span>{children}</span>
    </Group>
  );
}

interface Row extends ShownNumber {
  readonly key: string;
  readonly isLimit: boolean;
  /** Of a limit. */
  readonly most: number | undefined;
}

function rowOf(key: string, tuning: Tuning, figures: readonly Metric[]): Row {
  const isLimit = key.startsWith("limits.");
  return {
    ...ofKey(key, tuning, figures),
    key,
    isLimit,
    most: isLimit ? tuning.limits[Number(key.slice("limits.".length))]?.at_most : undefined,
  };
}

const ROADS = { training: "training", fresh: "validation" } as const;

const columnsOf = (point: ComparedPoint, group: string) =>
  (["training", "fresh"] as const).map((roads): Column<Row> => ({
    key: `${point.trial} ${roads}`,
    group,
    head: ROADS[roads],
    headAttributes: { "data-trial": point.trial },
    attributes: ({ key }) => ({ "data-trial": point.trial, "data-value": point[roads][key]?.mean ?? "" }),
    cell: ({ key, scale, most }) => <Value figure={point[roads][key]} {...{ scale, most }} />,
  }));

function Value({ figure, scale, most }: { readonly figure: TunedFigure | undefined } & Pick<Row, "scale" | "most">) {
  if (!figure) return "–";
  if (most !== undefined)
    return <LimitValue value={formatResult(figure.worst * scale, 3)} over={figure.worst > most} />;
  return (
    <>
      <span className={tables.value}>{formatResult(figure.mean * scale, 3)}</span>
      <ChangeOf figure={figure} />
    </>
  );
}

export function ChangeOf({ figure: { change } }: { readonly figure: TunedFigure }) {
  if (!change) return <ChangeText change={null} />;
  const { value, low, high } = change;
  return (
    <SureChange {...{ value, low, high }}>
      {low === null || high === null
        ? "one road"
        : `${formatPercent(low).replace(/\u2009%$/, "")} to ${formatPercent(high)}`}
    </SureChange>
  );
}

type Keeps = "keeps" | "shrinks" | "unclear" | "worse" | "none";

/** Whether a gain on the training roads is still there on the validation roads, in a sentence. */
interface Gain {
  readonly trial: number;
  readonly objective: number;
  readonly keeps: Keeps;
  readonly text: string;
  /** What is worse for sure on the validation roads: its key and change [%], the largest first. */
  readonly worse: readonly (readonly [key: string, change: number])[];
}

/** `For it front tyre load is 20 % worse, and 2 more.`; nothing where nothing has to be paid. */
export function priceText({ keeps, worse }: Pick<Gain, "keeps" | "worse">, nameOf: (key: string) => string): string {
  if (keeps === "none") return "";
  if (worse.length === 0) return "Nothing else is worse for sure.";
  const shown = worse.slice(0, MOST_PRICES).map(([key, change]) => `${nameOf(key)} ${formatPercent(change)}`);
  const rest = worse.length - shown.length;
  return `Worse for it: ${shown.join(", ")}${rest > 0 ? ` and ${rest} more` : ""}.`;
}

const MOST_PRICES = 3;

const worseOf = ({ fresh }: ComparedPoint): Gain["worse"] =>
  Object.entries(fresh)
    .flatMap(([key, { change }]) => ((change?.low ?? 0) > 0 && change ? [[key, change.value] as const] : []))
    .sort(([, one], [, other]) => other - one);

/** A gain that is smaller than this part of the training roads' has shrunk; the two means differ a little anyway. */
const MOSTLY = 0.9;
/** What is not a gain on the training roads [%]. */
const LEAST = 0.05;

function keepsOf(training: number, validation: number, verdict: string | undefined): Keeps {
  if (training > -LEAST) return "none";
  if (verdict === "worse") return "worse";
  if (verdict !== "better") return "unclear";
  return validation / training < MOSTLY ? "shrinks" : "keeps";
}

const interval = (low: number | null, high: number | null) =>
  low === null || high === null ? "" : ` (${formatPercent(low)} to ${formatPercent(high)})`;

const ENDING: Readonly<Record<Keeps, string>> = {
  keeps: "the gain holds",
  shrinks: "less of the gain is left there",
  unclear: "no certain gain, as the interval holds zero",
  worse: "the weights are tuned to the training roads and worse elsewhere",
  none: "no gain over the first trial",
};

function gainOf(point: ComparedPoint, objective: number): Gain | null {
  if (point.roles.includes("paper"))
    return {
      trial: point.trial,
      objective,
      keeps: "none",
      worse: [],
      text: "No weights that were tried are better than the first trial’s on the training roads.",
    };
  const key = `objectives.${objective}`;
  const [training, validation] = [point.training[key]?.change, point.fresh[key]?.change];
  if (!training || !validation) return null;
  const keeps = keepsOf(training.value, validation.value, point.verdict?.[objective]);
  const text = `${formatPercent(training.value)} on the training roads, ${formatPercent(validation.value)}${interval(validation.low, validation.high)} on the validation roads: ${ENDING[keeps]}.`;
  return { trial: point.trial, objective, keeps, text, worse: worseOf(point) };
}

/** Each objective at the point that is best for it. */
export function gainsOf({ points }: TuningComparison, objectives: number): readonly Gain[] {
  return Array.from({ length: objectives }, (_, index) => points.find(({ roles }) => roles.includes(`best.${index}`)))
    .map((point, index) => (point ? gainOf(point, index) : null))
    .filter((gain) => gain !== null);
}
