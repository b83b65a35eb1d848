/** How the strategies do where car, sensors and actuators are not what they believe: a study put together, changed, followed and read. */

import { useSuspenseQuery } from "@tanstack/react-query";
import { SweepList, STUDY_LABEL, BatchState } from "../../features/sweep/SweepState";
import { usePageScenario } from "../../features/scenarioSource/scenarioSource";
import { ScenarioChoice, otherThanPaper } from "../../features/scenarioSource/ScenarioChoice";
import { uncertaintiesQuery } from "../../server/queries";
import { useForm, useCatalogues } from "../../server/useCatalogues";
import { NewJob } from "../../jobs/Jobs";
import { Page } from "../../ui/Page";
import { Button, Collapse, Text, Box, Checkbox, Group, Switch } from "@mantine/core";
import { useDisclosure } from "@mantine/hooks";
import { useParams } from "@tanstack/react-router";
import { useMemo, useId, type ReactNode } from "react";
import { Icon } from "../../ui/icons";
import { BatchFiles } from "../../features/export/FileMenu";
import { ShareAddress } from "../../features/share/ShareLink";
import { BATCH, useJob } from "../../jobs/useJob";
import { StudyResults } from "./StudyResults";
import { compact } from "../../ui/IconButton";
import type { Batch, Scenario } from "../../api/types";
import { StartFoot, useJobForm } from "../../features/jobForm/jobForm";
import { StrategyChoice, CubeEntries, amountOf, notesOf, sweepFieldName } from "../../features/sweep/sweepForm";
import { prettyUnit } from "../../units/format";
import { draftStudy, exactText, restoreStudy, type RangeDraft, type StudyDraft, readStudy } from "./study";
import ui from "../../ui/ui.module.css";
import { useDraft } from "../../lib/useDraft";
import { Entry } from "../../ui/Entry";
import { Fault, Problems, Note } from "../../ui/Messages";
import { ask } from "../../api/http";
import { withKey } from "../../api/jobs";
import { submits } from "../../ui/ListEntry";
import { Columns } from "../../ui/Card";

export function RobustnessPage() {
  const source = usePageScenario();
  const lead =
    "The controllers assume one car, exact sensors and ideal actuators. Here every strategy drives the same random cars, whose sensors and actuators differ a little from that. How much of each lead is left? With the paper’s weights LV keeps its lead over LQR on the bump and loses it on the rough road; with the preset Robust LV it keeps both, as long as its own state is measured exactly.";
  return (
    <Page title="Robustness" lead={lead}>
      <StudyForm scenario={source.scenario} head={<ScenarioChoice source={source} />} />
      <SweepList studies />
    </Page>
  );
}

export function StudyPage() {
  const { id } = useParams({ from: "/robustness/$id" });
  const { job: batch, connected, left } = useJob(BATCH, id);
  const catalogues = useCatalogues();
  const [changing, { toggle }] = useDisclosure(false);

  const { strategies } = catalogues;
  const ids = batch.strategies;
  const studied = useMemo(() => strategies.filter((each) => ids.some((id) => id === each.id)), [strategies, ids]);
  const tools = (
    <>
      <Button
        aria-expanded={changing}
        aria-label="Change it"
        classNames={compact}
        leftSection={<Icon name="Adjustments" size={15} />}
        onClick={toggle}
      >
        Change it
      </Button>
      <NewJob to="/robustness" label="New study" />
      <ShareAddress what="study" ready />
      <BatchFiles batch={batch} />
    </>
  );
  return (
    <Page title="Robustness study" heading="Robustness" tools={tools}>
      <Collapse expanded={changing}>
        <StudyForm
          scenario={batch.scenario}
          existing={batch}
          head={
            <Text>
              The scenario of this study.{" "}
              <Text span c="dimmed">
                {otherThanPaper(batch.scenario, catalogues.form)}
              </Text>
            </Text>
          }
        />
      </Collapse>
      <BatchState {...{ batch, connected, left }} readOnly={false} />
      <StudyResults batch={batch} {...catalogues} strategies={studied} />
    </Page>
  );
}

interface FormProps {
  readonly scenario: Scenario | undefined;
  /** Says which scenario it is. */
  readonly head: ReactNode;
  /** A study to begin from. */
  readonly existing?: Batch;
}

function StudyForm({ scenario, head, existing }: FormProps) {
  const form = useForm();
  const defaults = useSuspenseQuery(uncertaintiesQuery).data;
  const initial = () => draftStudy(defaults, form, existing);
  const stored = useDraft({
    name: existing ? "changed study" : "study",
    of: existing?.id,
    initial,
    restore: (texts) => restoreStudy(texts, initial()),
  });
  const { draft, patch } = stored;
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
        <StrategyChoice {...{ draft, errors }} onChange={patch} />
        <CubeEntries
          {...{ draft, errors }}
          w="17rem"
          descriptions={["Random cars from a Latin hypercube", "Same seed, same cars"]}
          onChange={patch}
        />
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
    <Group gap="0 0.8rem" mih="3.1rem" py="0.2rem" style={UNDERLINED} data-field={field.name}>
      <Switch
        size="xs"
        flex="1 1 12rem"
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
      <Group gap="0.4rem" wrap="nowrap" ml="auto">
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
      {error !== undefined && (
        <Fault id={`${id}-error`} w="100%" pb="0.4rem">
          {error}
        </Fault>
      )}
    </Group>
  );
}

const UNDERLINED = { borderBottom: "1px solid var(--line)" };

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
    parsed,
    bodyOf: ({ cube }) =>
      scenario ? { scenario, strategies: draft.strategies, sweep: cube, label: STUDY_LABEL } : null,
    fieldNameOf: sweepFieldName(draft.ranges.map(({ field }) => field.name)),
    estimate: (body, signal) => ask("post", "/batches", { body: { ...body, dry_run: true } }, signal),
    onSubmitted,
    submit: async (body, keyOf) => {
      const submit = (sent: typeof body) => ask("post", "/batches", { body: sent, ...withKey(keyOf(sent)) });
      const oneByOne = parsed.ok ? parsed.body.oneByOne : null;
      const alone = oneByOne && (await submit({ ...body, sweep: oneByOne, label: `${STUDY_LABEL}: each field alone` }));
      return { to: "/robustness/$id", params: { id: (await submit(body)).id }, search: alone ? { one: alone.id } : {} };
    },
  });
}
