/** The paper's weights and the tuned ones, on the training and on the validation roads. */

import { Skeleton, Text } from "@mantine/core";
import { IconAlertTriangle, IconCheck, IconEqual } from "../icons";
import type { ComparedPoint, TunedFigure, Tuning } from "../api/types";
import { isFinal } from "../jobs/follow";
import type { Figure } from "../batch/figures";
import { formatPercent } from "../tables/change";
import tables from "../tables/tables.module.css";
import { formatResult, prettyUnit } from "../units/format";
import { ofKey, type Shown } from "./figures";
import { gainsOf, type Gain, type Keeps } from "./gain";
import { roleName } from "./points";
import results from "./results.module.css";
import { ScrollTable } from "../ui/ScrollTable";
import { Card } from "../ui/Card";
import ui from "../ui/ui.module.css";

interface Props {
  readonly tuning: Tuning;
  readonly objectives: readonly Shown[];
  readonly figures: readonly Figure[];
}

const SIGN: Readonly<Record<Keeps, typeof IconCheck>> = { keeps: IconCheck, shrinks: IconAlertTriangle, unclear: IconAlertTriangle, worse: IconAlertTriangle, none: IconEqual };

export function ValidationTable({ tuning, objectives, figures }: Props) {
  const { comparison } = tuning;
  if (!comparison) {
    return (
      <Card aria-label="Validation roads" aria-busy={!isFinal(tuning) || undefined} title="Validation roads">
        <div className={ui.note}>
          <Text size="sm" c="dimmed">
            {isFinal(tuning)
              ? "The comparison is made once the search is complete: resume it for that."
              : `When the search is complete, the best weights drive ${tuning.fresh_seeds.length} roads they were not tuned on, beside the paper’s.`}
          </Text>
          {tuning.step === "comparison" && !isFinal(tuning) && <Skeleton height={120} radius={6} mt={10} />}
        </div>
      </Card>
    );
  }
  const labels = objectives.map(({ label }) => label);
  const gains = gainsOf(comparison, objectives.length);
  const [paper, ...tuned] = comparison.points;
  return (
    <Card aria-label="Validation roads" title={`Validation: ${tuning.seeds.length} training and ${tuning.fresh_seeds.length} validation roads`}>
      <ul className={results.gains}>
        {gains.map((gain) => (
          <GainLine key={gain.objective} gain={gain} label={labels.length > 1 ? (labels[gain.objective] ?? "") : ""} />
        ))}
        {comparison.points.flatMap(({ trial, failures }) =>
          failures.map((failure) => (
            <li key={`${trial} ${failure}`} data-keeps="worse">
              <IconAlertTriangle size={16} stroke={2} aria-hidden />
              <span>
                Trial {trial} could not be run on every road; left out: {failure}
              </span>
            </li>
          )),
        )}
      </ul>
      <ScrollTable label="The paper’s and the tuned weights over training and validation roads" className={results.validation}>
        <thead>
          <tr>
            <td />
            {comparison.points.map((point) => (
              <th key={point.trial} scope="colgroup" colSpan={2} data-trial={point.trial}>
                {point.roles.map((role) => roleName(role, labels)).join(", ")} <span className={ui.dim}>trial {point.trial}</span>
              </th>
            ))}
          </tr>
          <tr>
            <td />
            {comparison.points.flatMap(({ trial }) => [
              <th key={`${trial} training`} scope="col" data-first>
                training
              </th>,
              <th key={`${trial} fresh`} scope="col">
                validation
              </th>,
            ])}
          </tr>
        </thead>
        <tbody>
          {comparison.figures.map(({ key }) => {
            const { label, unit, scale } = ofKey(key, tuning, figures);
            const isLimit = key.startsWith("limits.");
            const most = isLimit ? tuning.limits[Number(key.slice("limits.".length))]?.at_most : undefined;
            return (
              <tr key={key} data-figure={key}>
                <th scope="row" className={tables.quantity}>
                  {label}
                  {isLimit && ", largest"} <span className={ui.dim}>{prettyUnit(unit)}</span>
                </th>
                {[paper, ...tuned].flatMap((point) =>
                  point ? [<Cell key={`${point.trial} t`} figure={point.training[key]} first {...{ scale, most, point }} />, <Cell key={`${point.trial} f`} figure={point.fresh[key]} {...{ scale, most, point }} />] : [],
                )}
              </tr>
            );
          })}
        </tbody>
      </ScrollTable>
      <Text size="xs" c="dimmed" className={ui.note ?? ""}>
        Means over the roads; the change against the paper’s weights with its 95 % interval, paired road by road. An arrow stands only where the interval does not hold zero.
      </Text>
    </Card>
  );
}

function GainLine({ gain: { keeps, text }, label }: { readonly gain: Gain; readonly label: string }) {
  const Icon = SIGN[keeps];
  return (
    <li data-keeps={keeps}>
      <Icon size={16} stroke={2} aria-hidden />
      <span>
        {label !== "" && <strong>{label}: </strong>}
        {text}
      </span>
    </li>
  );
}

interface CellProps {
  readonly figure: TunedFigure | undefined;
  readonly scale: number;
  /** Of a limit. */
  readonly most: number | undefined;
  readonly point: ComparedPoint;
  readonly first?: boolean;
}

function Cell({ figure, scale, most, point, first = false }: CellProps) {
  if (!figure) return <td className={tables.cell}>–</td>;
  const over = most !== undefined && figure.worst > most;
  return (
    <td className={`${tables.cell ?? ""} ${over ? (ui.error ?? "") : ""}`} data-first={first || undefined} data-trial={point.trial} data-value={figure.mean}>
      <span className={tables.value}>{formatResult((most === undefined ? figure.mean : figure.worst) * scale, 3)}</span>
      {most === undefined ? <ChangeOf figure={figure} /> : <span className={tables.change}>{over ? "over the limit" : "\u00a0"}</span>}
    </td>
  );
}

function ChangeOf({ figure: { change } }: { readonly figure: TunedFigure }) {
  if (!change) return <span className={tables.change}>&nbsp;</span>;
  const { value, low, high } = change;
  const verdict = high !== null && high < 0 ? "better" : low !== null && low > 0 ? "worse" : "same";
  return (
    <>
      <span className={tables.change} data-verdict={verdict}>
        <span aria-hidden>{verdict === "better" ? "▼ " : verdict === "worse" ? "▲ " : ""}</span>
        {formatPercent(value)}
        <span className="visually-hidden">, {verdict === "same" ? "unclear" : verdict}</span>
      </span>
      <span className={results.interval}>{low === null || high === null ? "one road" : `${formatPercent(low).replace(/\u2009%$/, "")} to ${formatPercent(high)}`}</span>
    </>
  );
}
