/** The search as a plot, and beside it the weights of the point somebody looks at. */

import { Button, Stack, Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useState } from "react";
import type { Trial } from "../../api/types";
import { ChangeMark } from "../../features/tables/ChangeMark";
import { formatInput, formatResult, prettyUnit } from "../../units/format";
import type { Point } from "./points";
import { SearchCard } from "./SearchCard";
import results from "./results.module.css";
import { trialsQuery } from "./queries";
import { WeightsOf } from "./WeightsOf";
import { Choice } from "../../ui/Entry";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";
import type { TuningParts } from "./props";

const NO_TRIALS: readonly Trial[] = [];

export function TuningPlot({ tuning, objectives, limits, tunable, points, colour, load }: TuningParts) {
  const [selectedNumber, setSelectedNumber] = useState<number | null>(null);
  const trials = useQuery({ ...trialsQuery(tuning), enabled: tuning.paper !== null });
  const all = trials.data?.trials ?? NO_TRIALS;
  const opening = points.find(({ names }) => names.includes("Balanced")) ?? points.at(-1);
  const picked =
    all.find(({ number }) => number === selectedNumber) ??
    points.find(({ trial }) => trial.number === selectedNumber)?.trial ??
    opening?.trial ??
    null;
  return (
    <div className={results.plotRow}>
      <SearchCard
        {...{ tuning, objectives, points, colour }}
        trials={all}
        fault={trials.error}
        picked={picked?.number ?? null}
        onPick={setSelectedNumber}
      />
      {picked && (
        <Card aria-label="Selected point" data-trial={picked.number}>
          <Stack gap="sm" p="0.8rem 0.9rem">
            <Choice
              label="Weights of trial"
              value={String(picked.number)}
              data={options(points, tuning.front, picked)}
              onPick={(value) => setSelectedNumber(Number(value))}
            />
            <Values {...{ tuning, objectives, limits }} trial={picked} />
            <WeightsOf weights={picked.weights} beside={tuning.paper?.weights} tunable={tunable} />
            {picked.number !== tuning.paper?.number && (
              <Text size="xs" c="dimmed">
                Struck through: the paper’s.
              </Text>
            )}
            <Button size="xs" loading={load.opening?.number === picked.number} onClick={() => load.open(picked)}>
              Load in lab
            </Button>
          </Stack>
        </Card>
      )}
    </div>
  );
}

function options(points: readonly Point[], front: readonly Trial[], picked: Trial) {
  const named = points.map(({ trial, names }) => ({
    value: String(trial.number),
    label: `${trial.number}: ${names.join(", ")}`,
  }));
  const others = [...front, picked].filter(
    ({ number }, index, all) =>
      !points.some(({ trial }) => trial.number === number) && all.findIndex((each) => each.number === number) === index,
  );
  return [...named, ...others.map(({ number }) => ({ value: String(number), label: `${number}` }))];
}

function Values({
  tuning,
  objectives,
  limits,
  trial,
}: Pick<TuningParts, "tuning" | "objectives" | "limits"> & { readonly trial: Trial }) {
  return (
    <dl className={results.values}>
      {objectives.map(({ label, unit, scale }, index) => (
        <div key={label}>
          <dt>{label}</dt>
          <dd>
            {trial.values ? `${formatResult((trial.values[index] ?? NaN) * scale, 4)} ${prettyUnit(unit)}` : "–"}{" "}
            {trial.number !== tuning.paper?.number && (
              <ChangeMark value={trial.values?.[index]} baseline={tuning.paper?.values?.[index]} />
            )}
          </dd>
        </div>
      ))}
      {limits.map(({ label, unit, scale }, index) => {
        const [value, most] = [trial.limits?.[index], tuning.limits[index]?.at_most ?? Infinity];
        return (
          <div key={label}>
            <dt>{label}, largest</dt>
            <dd className={value !== undefined && value > most ? ui.error : undefined}>
              {value === undefined ? "–" : `${formatResult(value * scale)} ${prettyUnit(unit)}`}
              {value !== undefined && value > most && ` (limit ${formatInput(Number((most * scale).toPrecision(6)))})`}
            </dd>
          </div>
        );
      })}
      {trial.status === "failed" && (
        <div>
          <dt className={ui.error}>Failed</dt>
          <dd>{trial.reason}</dd>
        </div>
      )}
    </dl>
  );
}
