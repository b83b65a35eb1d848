/** How large may a field be, so that a metric keeps a limit? Asked over the form's scenario, answered with a value for it. */

import { Button, Group, List, Modal, Select, Text } from "@mantine/core";
import { useDebouncedValue } from "@mantine/hooks";
import { useMutation } from "@tanstack/react-query";
import { useMemo, useState } from "react";
import { ask } from "../../api/http";
import { ApiProblem, explain } from "../../api/problem";
import type { Question, Scenario, Solution, Strategy } from "../../api/types";
import { fullName, optionsOf, type Metric } from "../../server/metrics";
import { typedText, valueText } from "../../scenario/limits";
import { isRecording } from "../../lib/recording";
import { getAt, setAt } from "../../scenario/path";
import type { NumberField } from "../../scenario/schema";
import { useEdit, useLab, useReadOnly, useScenario, useView } from "../../lab/context";
import { useCatalogues } from "../../server/useCatalogues";
import { pointerOf, sweepFields, type SweepField } from "../../scenario/fields";
import { Fault } from "../../ui/Messages";
import { grouped } from "../../lib/order";
import { Entry, labelled } from "../../ui/Entry";
import { formatExact, formatInput, formatResult, prettyUnit } from "../../units/format";
import { curveOf, LimitChart } from "./LimitChart";
import { ALL, askable, otherField, readDraft, type Range, type SolveDraft, translateUnits } from "./draft";
import ui from "../../ui/ui.module.css";

const [TARGET, INITIAL] = ["speed.target_speed_kmh", "speed.initial_speed_kmh"] as const;

/** The speed that a strategy meets the bump at: the target where it slows down for it. */
function speedField(strategy: Strategy | undefined, scenario: Scenario): string {
  const policy = getAt(scenario, "/speed/policy");
  if (policy === "constant") return INITIAL;
  return policy === "planned" || strategy?.reads.includes(TARGET) === true ? TARGET : INITIAL;
}

/** A number that is being typed is not driven at each digit [ms]. */
const TYPED_MS = 500;

const isNoSolution = (error: Error) => error instanceof ApiProblem && error.kind === "no-solution";

/** In the units of the page: the service's own sentence is in SI. */
const noSolution = (field: NumberField, { range: [low, high], requirements }: Question) =>
  `No value tried from ${valueText(field, low)} to ${valueText(field, high)} keeps ${requirements ? "every requirement. Choose another range" : "the limit. Choose another range or limit"}.`;

interface Props {
  /** Asked about first. */
  readonly metric: string;
  readonly onClose: () => void;
}

export function SolveDialog({ metric: first, onClose }: Props) {
  const { form, strategies, figures } = useCatalogues();
  const fields = useMemo(() => sweepFields(form).filter(askable), [form]);
  const scenario = useScenario();
  const switchedOn = useLab((state) => state.strategies);
  const selected = useMemo(() => switchedOn.filter((id) => !isRecording(id)), [switchedOn]);
  const roads = useLab((state) => state.roads);
  const { requirements, baseline } = useView();
  const byId = (id: string | undefined) => strategies.find((each) => each.id === id);
  const [draft, setDraft] = useState<SolveDraft>(() => ({
    ...rangeOf(fields, speedField(byId(selected[0]), scenario)),
    strategy: selected[0] ?? strategies[0]?.id ?? "",
    metric: first,
    limit: "",
    roads: String(roads),
  }));
  // The metric whose limit nobody has typed or dragged yet: the chart gives it one.
  const [unlimited, setUnlimited] = useState<string | null>(first);
  // An empty field is wrong only when somebody asks.
  const [asked, setAsked] = useState(false);
  const field = fields.find(({ name }) => name === draft.field);
  const figure = figures.find(({ key }) => key === draft.metric);
  const leaf = field?.leaf.kind === "number" ? field.leaf : null;
  const { question, wrong, driven } = useMemo(() => {
    const held = draft.metric === ALL ? { requirements, baseline } : figure;
    return leaf && held ? readDraft(draft, leaf, held) : { question: null, wrong: {}, driven: null };
  }, [draft, leaf, figure, requirements, baseline]);
  const [typed] = useDebouncedValue(
    useMemo(() => ({ driven, field: draft.field }), [driven, draft.field]),
    TYPED_MS,
  );
  // Another field has other values: none of it is asked for over those of the one before.
  const settled = typed.field === draft.field ? typed.driven : null;
  const isSpeed = draft.field === speedField(byId(draft.strategy), scenario);
  const search = useMutation({
    mutationFn: (body: Question) => ask("post", "/solve", { body: { scenario, ...body } }),
  });
  const patch = (change: Partial<SolveDraft>) => {
    search.reset();
    setAsked(false);
    setDraft({ ...draft, ...change });
  };
  /** The speed that the other strategy meets the bump at, where it is asked for the speed. */
  const withSpeedOf = (id: string) => {
    const [before, after] = [draft.strategy, id].map((strategy) => speedField(byId(strategy), scenario)) as [
      string,
      string,
    ];
    return draft.field === before ? otherField(draft, rangeOf(fields, before), rangeOf(fields, after)) : {};
  };
  const find = () => {
    setAsked(true);
    if (question) search.mutate(question);
  };
  const entry = (key: "from" | "to" | "limit" | "roads", label: string, unit: string) => (
    <Entry
      w="7.3rem"
      value={draft[key]}
      error={asked || draft[key] !== "" ? wrong[key] : undefined}
      {...{ label, unit }}
      onType={(text) => {
        if (key === "limit") setUnlimited(null);
        patch({ [key]: text });
      }}
    />
  );
  const unit = leaf?.shown.unit ?? "1";
  return (
    <Modal
      opened
      onClose={onClose}
      title={isSpeed ? "How fast may it go?" : "How large may it be?"}
      size="lg"
      classNames={{ body: ui.stack ?? "" }}
    >
      <Text c="dimmed">
        A metric over a field, for every strategy that is on: drag the limit to see where each keeps it. Find gives one
        strategy’s largest value exactly, over several roads with its 95 % interval. Everything else stays as in the
        form.
      </Text>
      <Group gap="xs" align="flex-start">
        <Select
          label="Field"
          searchable
          allowDeselect={false}
          data={grouped(
            fields,
            ({ section }) => section,
            ({ name, title }) => ({ value: name, label: title }),
          )}
          value={draft.field}
          onChange={(name) => name !== null && patch(rangeOf(fields, name))}
        />
        <Group gap="xs" wrap="nowrap" align="flex-start">
          {entry("from", "From", unit)}
          {entry("to", "To", unit)}
        </Group>
      </Group>
      <Group gap="xs" align="flex-start">
        <Select
          label="Strategy"
          allowDeselect={false}
          data={labelled(strategies)}
          value={draft.strategy}
          onChange={(id) => id !== null && patch({ strategy: id, ...withSpeedOf(id) })}
        />
        <Select
          label="Metric"
          w={250}
          searchable
          allowDeselect={false}
          data={[
            ...(requirements.length > 0
              ? [{ group: "Of the lab", items: [{ value: ALL, label: "All requirements" }] }]
              : []),
            ...optionsOf(figures),
          ]}
          value={draft.metric}
          onChange={(key) => {
            setUnlimited(key);
            if (key !== null) patch({ metric: key, limit: "" });
          }}
        />
        {figure && entry("limit", "At most", figure.unit)}
        {entry("roads", "Roads", "1")}
      </Group>
      {settled && leaf && figure && (
        <LimitChart
          {...{ scenario, figure }}
          field={leaf}
          question={{
            ...settled,
            metric: draft.metric,
            fieldOf: (strategy) => (isSpeed ? speedField(strategy, scenario) : draft.field),
          }}
          strategies={strategies.filter(({ id }) => selected.includes(id))}
          limit={question?.limit ?? null}
          isOpening={unlimited === figure.key}
          onLimit={(limit) => {
            setUnlimited(null);
            patch({ limit: formatInput(Number((limit * figure.scale).toPrecision(3))) });
          }}
        />
      )}
      {!figure && wrong.limit !== undefined && <Fault>{wrong.limit}</Fault>}
      {search.error && (
        <Fault>{leaf && isNoSolution(search.error) ? noSolution(leaf, search.variables) : explain(search.error)}</Fault>
      )}
      {search.data && field && <Answer {...{ field, figure, onClose }} solution={search.data} />}
      <Group justify="flex-end" gap="xs">
        <Button size="sm" onClick={onClose}>
          Close
        </Button>
        <Button size="sm" variant="filled" disabled={!leaf} loading={search.isPending} onClick={find}>
          Find
        </Button>
      </Group>
    </Modal>
  );
}

function rangeOf(fields: readonly SweepField[], name: string): Range {
  const field = fields.find((each) => each.name === name);
  const leaf = field?.leaf.kind === "number" ? field.leaf : null;
  const [low, high] = leaf?.soft ?? [0, 1];
  return { field: name, from: leaf ? typedText(leaf, low) : "", to: leaf ? typedText(leaf, high) : "" };
}

interface AnswerProps {
  readonly solution: Solution;
  readonly field: SweepField;
  /** `undefined` where all requirements have to hold. */
  readonly figure: Metric | undefined;
  readonly onClose: () => void;
}

function Answer({ solution, field, figure, onClose }: AnswerProps) {
  const edit = useEdit();
  const readOnly = useReadOnly();
  const [, above] = solution.bracket;
  const isWhole = above === solution.value;
  const isDriven = curveOf(solution.tried).some(([value]) => value === above);
  const beyond = isDriven ? `does not keep ${figure ? "the limit" : "all of them"}` : "could not be tried";
  const isExact = solution.resolved_value === solution.value;
  const text = (value: number) =>
    field.leaf.kind === "number" ? valueText(field.leaf, value) : formatExact(value, solution.unit);
  const take = () => {
    edit.commit(setAt(edit.newest(), pointerOf(field.name), solution.value));
    onClose();
  };
  return (
    <div role="status">
      <Group gap="sm">
        <Text fw={600}>
          {isWhole
            ? `${figure ? "The limit holds" : "All requirements pass"} at ${text(solution.value)}, the top of the range; the largest value may lie beyond`
            : `${field.title} at most ${isExact ? "" : "about "}${text(solution.resolved_value)}`}
        </Text>
        {!readOnly && (
          <Button size="compact-sm" variant="light" onClick={take}>
            Put it into the form
          </Button>
        )}
      </Group>
      <Text>
        {figure
          ? `${fullName(figure)}: ${formatResult(solution.metric_value * figure.scale)} ${prettyUnit(figure.unit)}`
          : `All requirements pass; the strictest limit is used to ${formatResult(100 * solution.metric_value)} %`}{" "}
        at {text(solution.value)}
        {solution.interval ? ", the upper end of its interval" : ""}
        {isWhole ? "." : `; ${text(above)} ${beyond}.`}
      </Text>
      {solution.warnings.length > 0 && (
        <List size="sm">
          {solution.warnings.map((warning) => (
            <List.Item key={warning}>{translateUnits(warning, field, figure)}</List.Item>
          ))}
        </List>
      )}
    </div>
  );
}
