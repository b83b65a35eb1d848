/** What is uncertain, and between which ends; under which strategies; at how many points. */

import { Box, Checkbox, Group, Switch } from "@mantine/core";
import { useId, type ReactNode, useMemo } from "react";
import type { Batch, RobustnessDefaults, Scenario, Strategy } from "../../api/types";
import type { Group as Form } from "../../scenario/schema";
import { StartFoot } from "../../features/jobForm/StartFoot";
import { StrategyChoice } from "../../features/sweep/StrategyChoice";
import { amountOf, notesOf, sweepFieldName } from "../../features/sweep/useSweep";
import { prettyUnit } from "../../units/format";
import { draftStudy, exactText, restoreStudy, type RangeDraft, type StudyDraft, readStudy } from "./study";
import rows from "./form.module.css";
import ui from "../../ui/ui.module.css";
import { useDraft } from "../../lib/useDraft";
import { Entry } from "../../ui/Entry";
import { Fault, Problems, Note } from "../../ui/Messages";
import { ask } from "../../api/http";
import { withKey } from "../../api/jobs";
import { STUDY_LABEL } from "../../features/sweep/SweepList";
import { useJobForm } from "../../features/jobForm/useJobForm";
import { submits } from "../../ui/ListEntry";
import { Columns } from "../../ui/Card";

interface Props {
  readonly defaults: RobustnessDefaults;
  readonly strategies: readonly Strategy[];
  readonly form: Form;
  readonly scenario: Scenario | undefined;
  /** Says which scenario it is. */
  readonly head: ReactNode;
  /** A study to begin from. */
  readonly existing?: Batch;
}

export function StudyForm({ defaults, strategies, form, scenario, head, existing }: Props) {
  const initial = () => draftStudy(defaults, form, existing);
  const stored = useDraft({
    name: existing ? "changed study" : "study",
    of: existing?.id,
    initial,
    restore: (texts) => restoreStudy(texts, initial()),
  });
  const { draft, setDraft } = stored;
  const patch = (change: Partial<StudyDraft>) => setDraft({ ...draft, ...change });
  const submission = useStudy(draft, scenario, stored.forget);
  const { errors, general } = submission;
  return (
    <form className={ui.card} aria-label="Study" onSubmit={submits(() => submission.start())}>
      <div className={ui.part}>{head}</div>
      <div className={ui.part}>
        <h2 className={ui.heading}>What is uncertain</h2>
        <Note>
          All values between the two ends are equally likely. A field that is switched off has the scenario’s value.
        </Note>
        <Columns gap="0 1.6rem">
          {draft.ranges.map((range) => (
            <RangeRow
              key={range.field.name}
              range={range}
              scenario={scenario}
              error={range.on ? errors[range.field.name] : undefined}
              onChange={(change) =>
                patch({ ranges: draft.ranges.map((each) => (each === range ? { ...each, ...change } : each)) })
              }
            />
          ))}
        </Columns>
        {errors.fields !== undefined && <Fault>{errors.fields}</Fault>}
      </div>
      <div className={ui.part}>
        <StrategyChoice
          strategies={strategies}
          selected={draft.strategies}
          error={errors.strategies}
          onChange={(ids) => patch({ strategies: ids })}
        />
        <Group gap="0.8rem 1.2rem" align="flex-start">
          <Entry
            w="17rem"
            label="Samples"
            description="Random cars from a Latin hypercube"
            inputMode="numeric"
            value={draft.samples}
            error={errors.samples}
            onType={(samples) => patch({ samples })}
          />
          <Entry
            w="17rem"
            label="Seed"
            description="Same seed, same cars"
            inputMode="numeric"
            value={draft.seed}
            error={errors.seed}
            onType={(seed) => patch({ seed })}
          />
        </Group>
        <Checkbox
          label="Also vary each field alone, to both ends of its range"
          checked={draft.oneByOne}
          onChange={(event) => patch({ oneByOne: event.currentTarget.checked })}
        />
      </div>
      <Problems messages={general} mx="md" mb="xs" />
      <StartFoot inForm {...{ submission, draft: stored }} amount={amountOf(draft.strategies.length)} notes={notesOf} />
    </form>
  );
}

interface RowProps {
  readonly range: RangeDraft;
  readonly scenario: Scenario | undefined;
  readonly error: string | undefined;
  readonly onChange: (change: Partial<RangeDraft>) => void;
}

function RangeRow({ range: { field, why, on, from, to }, scenario, error, onChange }: RowProps) {
  const id = useId();
  const unit = field.leaf.kind === "number" ? prettyUnit(field.leaf.shown.unit) : "";
  const end = (key: "from" | "to", value: string) => (
    <Entry
      w="4.6rem"
      aria-label={`${field.title}, ${key}`}
      value={value}
      error={error !== undefined}
      {...(error === undefined ? {} : { "aria-describedby": `${id}-error` })}
      onType={(text) => onChange({ [key]: text })}
    />
  );
  return (
    <div className={rows.range} data-off={!on || undefined} data-field={field.name}>
      <Switch
        size="xs"
        checked={on}
        onChange={(event) => onChange({ on: event.currentTarget.checked })}
        label={
          <>
            <Box component="span" display="block" fz="sm" lh="1.25" {...(on ? { fw: 600 } : { c: "dimmed" })}>
              {titleOf(field.name, field.title)}
            </Box>
            <Box component="span" display="block" fz="xs" lh="1.25" c="dimmed">
              {why}
            </Box>
          </>
        }
      />
      <Group gap="0.4rem" wrap="nowrap" m={{ base: "0.3rem 0 0 2.6rem", xs: 0 }}>
        {on ? (
          <>
            {end("from", from)}
            <span aria-hidden>–</span>
            {end("to", to)}
            <Box component="span" w="1.6rem" fz="xs" c="dimmed">
              {unit}
            </Box>
          </>
        ) : (
          <Box component="span" fz="sm" c="dimmed">
            {exactText(field, scenario)}
          </Box>
        )}
      </Group>
      {error !== undefined && <Fault id={`${id}-error`}>{error}</Fault>}
    </div>
  );
}

/** Fields whose own title says too little outside their part of the form. */
function titleOf(name: string, title: string): string {
  if (name.startsWith("actuator.")) return `Actuator ${title.toLowerCase()}`;
  return name === "road.seed" ? "Road" : title;
}

/** A study written in the form, as batches to submit: the cube and, on request, each field alone. */
function useStudy(draft: StudyDraft, scenario: Scenario | undefined, onSubmitted: () => void) {
  const parsed = useMemo(() => readStudy(draft), [draft]);
  return useJobForm({
    kind: "batch",
    body:
      parsed.ok && scenario
        ? { scenario, strategies: draft.strategies, sweep: parsed.sweeps.cube, label: STUDY_LABEL }
        : null,
    errors: parsed.ok ? null : parsed.errors,
    fieldNameOf: sweepFieldName(draft.ranges.map(({ field }) => field.name)),
    estimate: (body, signal) => ask("post", "/batches", { body: { ...body, dry_run: true } }, signal),
    onSubmitted,
    submit: async (body, keyOf) => {
      const submit = (sent: typeof body) => ask("post", "/batches", { body: sent, ...withKey(keyOf(sent)) });
      const oneByOne = parsed.ok ? parsed.sweeps.oneByOne : null;
      const alone = oneByOne && (await submit({ ...body, sweep: oneByOne, label: `${STUDY_LABEL}: each field alone` }));
      return { to: "/robustness/$id", params: { id: (await submit(body)).id }, search: alone ? { one: alone.id } : {} };
    },
  });
}
