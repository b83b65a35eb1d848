/** How far a tuning is, what it is about, and how to continue it. */

import { Button, Group } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useState } from "react";
import { ask } from "../../api/http";
import type { Tuning } from "../../api/types";
import { otherThanPaper } from "../../features/scenarioSource/ScenarioChoice";
import { optionTitle } from "../../scenario/schema";
import { jobQuery, isFinal, BATCH, TUNING, useJobCall } from "../../jobs/useJob";
import { historyOf, JobState } from "../../jobs/Jobs";
import { useCatalogues } from "../../server/useCatalogues";
import { count, formatExact, formatWhole, parseInput } from "../../units/format";
import { shownOf } from "./space";
import { formatSeeds } from "./draft";
import { Entry } from "../../ui/Entry";
import ui from "../../ui/ui.module.css";
import { Note } from "../../ui/Messages";
import { submits } from "../../ui/ListEntry";

interface Props {
  readonly tuning: Tuning;
  readonly connected: boolean;
  readonly left: number | null;
}

const STATE = { running: "Searching", cancelled: "Cancelled; complete generations are kept" };

export function TuningState({ tuning, connected, left }: Props) {
  const { total, done, failed, feasible } = tuning.trials;
  const comparing = tuning.state === "running" && tuning.step === "comparison";
  const counts = (
    <>
      {formatWhole(done + failed)} of {count(total, "trial")}
      {failed > 0 && <span className={ui.error}>, {formatWhole(failed)} failed</span>}
      {tuning.limits.length > 0 && `, ${formatWhole(feasible)} within the limits`}
    </>
  );
  return (
    <JobState
      kind={TUNING}
      job={tuning}
      texts={comparing ? { running: "Comparing on the roads" } : STATE}
      resume={<Resume key={tuning.state} tuning={tuning} />}
      {...{ counts, connected }}
      left={comparing ? null : left}
    >
      {!isFinal(tuning) && <Within tuning={tuning} comparing={comparing} />}
      <Facts tuning={tuning} />
    </JobState>
  );
}

const WITHIN_MS = 1000;

/** How far the present generation is. */
function Within({ tuning, comparing }: { readonly tuning: Tuning; readonly comparing: boolean }) {
  const { data } = useQuery({
    ...jobQuery(BATCH, tuning.batch ?? ""),
    enabled: tuning.batch !== null,
    refetchInterval: WITHIN_MS,
  });
  const finished = data ? data.done + data.failed : 0;
  return (
    <Note>
      {data
        ? `${comparing ? "Comparison" : `Generation ${tuning.generation + 1}`}: ${formatWhole(finished)} of ${count(data.total, "run")}`
        : "\u00a0"}
    </Note>
  );
}

function Resume({ tuning }: { readonly tuning: Tuning }) {
  const { total } = tuning.trials;
  const least = tuning.state === "done" ? total + 1 : total;
  const [trials, setTrials] = useState(String(tuning.state === "done" ? 2 * total : total));
  const requested = parseInput(trials);
  const wrong = requested === null || !Number.isInteger(requested) || requested < least;
  const resume = useJobCall(TUNING, tuning.id, (number: number) =>
    ask("post", "/tunings/{id}/resume", { path: { id: tuning.id }, query: { trials: number } }),
  );
  return (
    <Group
      component="form"
      gap="0.4rem"
      onSubmit={submits(() => {
        if (!wrong) resume.mutate(requested);
      })}
    >
      <Entry
        w="8.2rem"
        aria-label="Trials in all"
        inputMode="numeric"
        value={trials}
        unit="trials"
        error={wrong}
        onType={setTrials}
      />
      <Button type="submit" disabled={wrong} loading={resume.isPending}>
        {tuning.state === "done" ? "Continue search" : "Resume"}
      </Button>
      {wrong && <span className={ui.error}>{formatWhole(least)} or more</span>}
      {resume.isError && (
        <span className={ui.error} role="alert">
          {resume.error.message}
        </span>
      )}
    </Group>
  );
}

function Facts({ tuning }: Pick<Props, "tuning">) {
  const { form, strategies, figures } = useCatalogues();
  const {
    scenario,
    search,
    previews,
    uncertain,
    quantile,
    seeds,
    fresh_seeds: validation,
    limits,
    objectives,
  } = tuning;
  const own = (name: string) => name.replace(/\.\d+$/, "");
  const limit = limits.map((each) => {
    const { label, unit, scale } = shownOf(each, figures);
    return `${label} at most ${formatExact(Number((each.at_most * scale).toPrecision(10)), unit)}`;
  });
  const facts: readonly (readonly [string, string])[] = [
    ["Strategy", strategies.find(({ id }) => id === tuning.strategy)?.label ?? tuning.strategy],
    [
      "Minimised",
      objectives
        .map(
          (each) =>
            shownOf(each, figures).label +
            (each.kind !== "figure" && each.q.some((q) => q !== 1) ? ` (q ${each.q.join(", ")})` : ""),
        )
        .join("; "),
    ],
    ...(limit.length > 0 ? [["Within", limit.join("; ")] as const] : []),
    [
      "Searched",
      [
        count(Object.keys(search).length, "number"),
        ...(previews ? [`preview ${previews.map(optionTitle).join(", ")}`] : []),
      ].join("; "),
    ],
    [
      "Roads",
      `training ${formatSeeds(seeds)}; validation ${formatSeeds(validation)}${uncertain ? "; car, sensors and actuators uncertain" : ""}`,
    ],
    ...(quantile === null
      ? []
      : [
          [
            "Judged by",
            quantile === 1
              ? "the worst training road"
              : `the ${formatExact(100 * quantile, "%")} quantile over the training roads`,
          ] as const,
        ]),
    ["Scenario", otherThanPaper(scenario, form, Object.keys(search).map(own))],
    ["Submitted", historyOf(tuning)],
  ];
  return (
    <dl className={ui.facts}>
      {facts.map(([term, text]) => (
        <div key={term}>
          <dt>{term}</dt>
          <dd>{text}</dd>
        </div>
      ))}
    </dl>
  );
}
