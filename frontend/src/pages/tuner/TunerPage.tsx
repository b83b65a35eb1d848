/** Puts a tuning together, over those there are. */

import { usePageScenario } from "../../features/scenarioSource/scenarioSource";
import { Page } from "../../ui/Page";
import ui from "../../ui/ui.module.css";
import { useNumericCatalogues, isTunable, numberFields, reads, tunableOf, type TunableNumber, shownOf } from "./space";
import type { Scenario } from "../../api/types";
import type { Metric } from "../../server/metrics";
import { JobList } from "../../jobs/Jobs";
import { TUNING } from "../../jobs/useJob";
import { Input, MultiSelect, SegmentedControl, Switch } from "@mantine/core";
import { useMemo } from "react";
import { ScenarioChoice } from "../../features/scenarioSource/ScenarioChoice";
import { optionTitle } from "../../scenario/schema";
import { count } from "../../units/format";
import { firstDraft, rangesFor, restoreTuning, type TuningDraft, readDraft, tuningFieldName } from "./draft";
import { LimitRows, ObjectiveRows, RangesTable } from "./FormRows";
import { useDraft } from "../../lib/useDraft";
import { StartFoot, useJobForm } from "../../features/jobForm/jobForm";
import { Problems, Note } from "../../ui/Messages";
import { Choice, Entry, SCROLLED } from "../../ui/Entry";
import { ask } from "../../api/http";
import { withKey } from "../../api/jobs";
import { submits } from "../../ui/ListEntry";
import { Columns } from "../../ui/Card";

export function TunerPage() {
  const lead =
    "Searches the weights of a strategy that minimise an objective on a few training roads: the paper’s normalised sum (Eq. 16), peaks, or any metric, within limits. Several objectives give a Pareto front. The paper’s weights are the first trial. At the end the best ones are compared with them on validation roads: this shows weights that fit only the training roads.";
  return (
    <Page title="Weight tuner" lead={lead}>
      <div className={ui.beside}>
        <NewTuning />
        <TuningList />
      </div>
    </Page>
  );
}

/** The tunings there are. */
function TuningList() {
  const { strategies, figures } = useNumericCatalogues();
  return (
    <JobList
      kind={TUNING}
      title="Earlier tunings"
      none="None yet. Choose in the form what has to become small and start; each tuning stays here with all its trials."
      describe={({ strategy, objectives, limits }) => ({
        title: strategies.find(({ id }) => id === strategy)?.label ?? strategy,
        details: [
          objectives.map((each) => shownOf(each, figures).label).join(", "),
          ...(limits.length > 0 ? [`within ${limits.map((each) => shownOf(each, figures).label).join(", ")}`] : []),
        ],
      })}
    />
  );
}

/** What an objective comes to over the roads. */
const QUANTILES = [
  { value: "", label: "the mean over the training roads" },
  { value: "0.9", label: "the 90 % quantile over the training roads" },
  { value: "1", label: "the worst training road" },
];

function NewTuning() {
  const { form, strategies, figures } = useNumericCatalogues();
  const source = usePageScenario();
  const stored = useDraft<TuningDraft>({
    name: "tuning",
    initial: () => firstDraft(form),
    restore: (texts) => restoreTuning(texts, form),
  });
  // A controller of one's own may have gone, or have other options, since somebody chose it.
  const draft = isTunable(form, stored.draft.strategy)
    ? { ...stored.draft, ranges: { ...rangesFor(form, stored.draft.strategy), ...stored.draft.ranges } }
    : firstDraft(form);
  const strategy = strategies.find(({ id }) => id === draft.strategy);
  const patch = (change: Partial<TuningDraft>) => stored.patch({ ...draft, ...change });
  const tunable = useMemo(() => tunableOf(form, draft.strategy), [form, draft.strategy]);
  const numbers = useMemo(() => numberFields(tunable).filter(({ name }) => reads(strategy, name)), [tunable, strategy]);
  const submission = useNewTuning(draft, numbers, figures, source.scenario, stored.forget);
  const { errors, general } = submission;
  const preview = reads(strategy, "mpc.preview") || draft.strategy === "lqr" ? tunable.preview : null;
  const entry = (
    key: "seeds" | "validationSeeds" | "trials" | "population" | "seed",
    label: string,
    description: string,
    field: string = key,
  ) => (
    <Entry
      {...{ label, description }}
      inputMode="text"
      value={draft[key]}
      error={errors[field]}
      onType={(text) => patch({ [key]: text })}
    />
  );
  return (
    <form className={ui.card} aria-label="New tuning" onSubmit={submits(() => submission.start())}>
      <Part title="What is tuned">
        <ScenarioChoice source={source} />
        <Input.Wrapper size="xs" label="Strategy" labelElement="div" labelProps={{ mr: "xs" }}>
          <SegmentedControl
            {...SCROLLED}
            aria-label="Strategy"
            value={draft.strategy}
            data={strategies.flatMap(({ id, label }) => (isTunable(form, id) ? [{ value: id, label }] : []))}
            onChange={(id) => patch({ strategy: id, ranges: rangesFor(form, id), previews: [] })}
          />
        </Input.Wrapper>
      </Part>
      <Part title="Minimise">
        <ObjectiveRows drafts={draft.objectives} errors={errors} onChange={(objectives) => patch({ objectives })} />
      </Part>
      <Part title="Within limits" detail="on every training road">
        <LimitRows drafts={draft.limits} errors={errors} onChange={(limits) => patch({ limits })} />
      </Part>
      <Part title="Weights and times" detail="searched between these ends, by ratio where both are above 0">
        <RangesTable
          {...{ tunable, errors }}
          fields={numbers}
          scenario={source.scenario}
          drafts={draft.ranges}
          onChange={(ranges) => patch({ ranges })}
        />
        {tunable.untuned.length > 0 && (
          <Note>
            Not tuned: {tunable.untuned.join(", ")}. Switches and choices stay as they are; a sweep tries them.
          </Note>
        )}
        {preview && (
          <MultiSelect
            maw="24rem"
            label={preview.title}
            description="Kinds to try; with fewer than two, the scenario’s is used"
            data={preview.options.map((option) => ({ value: option, label: optionTitle(option) }))}
            value={[...draft.previews]}
            error={errors.previews}
            onChange={(previews) => patch({ previews })}
          />
        )}
      </Part>
      <Part title="Roads and effort">
        <Switch
          size="xs"
          label="Uncertain car, sensors and actuators"
          description="On each road they differ at random, as in a robustness study; the controllers do not know by how much"
          checked={draft.uncertain}
          onChange={(event) => patch({ uncertain: event.currentTarget.checked })}
        />
        <Choice
          maw="24rem"
          label="Judge by"
          value={draft.quantile}
          error={errors.quantile}
          data={QUANTILES}
          onPick={(quantile) => patch({ quantile })}
        />
        <Columns least="9.5rem">
          {entry("seeds", "Training roads", "Seeds, such as 1-4, 7")}
          {entry("validationSeeds", "Validation roads", "None of the training roads", "fresh_seeds")}
          {entry("trials", "Trials", "Sets of weights tried")}
          {entry("population", "Population size", "Sets in a generation")}
          {entry("seed", "Search seed", "Same seed, same trials")}
        </Columns>
      </Part>
      <Problems
        messages={[...general, ...(errors.strategy === undefined ? [] : [errors.strategy])]}
        m="0 0.9rem 0.6rem"
      />
      <StartFoot
        inForm
        {...{ submission, draft: stored }}
        amount={({ runs, generations }) => `${count(runs, "run")} in ${count(generations, "generation")}`}
      />
    </form>
  );
}

interface PartProps {
  readonly title: string;
  readonly detail?: string;
  readonly children: React.ReactNode;
}

function Part({ title, detail, children }: PartProps) {
  return (
    <section className={ui.part} aria-label={title}>
      <h2 className={ui.heading}>
        {title}
        {detail !== undefined && <span className={ui.dim}> {detail}</span>}
      </h2>
      {children}
    </section>
  );
}

/** A tuning written in the form, as a request. */
function useNewTuning(
  draft: TuningDraft,
  numbers: readonly TunableNumber[],
  figures: readonly Metric[],
  scenario: Scenario | undefined,
  onSubmitted: () => void,
) {
  const parsed = useMemo(() => readDraft(draft, numbers, figures), [draft, numbers, figures]);
  return useJobForm({
    kind: "tuning",
    parsed,
    bodyOf: (choice) => (scenario ? { scenario, ...choice } : null),
    fieldNameOf: tuningFieldName,
    estimate: (body, signal) => ask("post", "/tunings", { body: { ...body, dry_run: true } }, signal),
    onSubmitted,
    submit: async (body, keyOf) => ({
      to: TUNING.page,
      params: { id: (await ask("post", "/tunings", { body, ...withKey(keyOf(body)) })).id },
    }),
  });
}
