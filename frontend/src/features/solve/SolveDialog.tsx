/** How large may a field be, so that a metric keeps a limit? Asked over the form's scenario, answered with a value for it. */

import { Button, Group, List, Modal, Select, Text } from "@mantine/core";
import { useDebouncedValue } from "@mantine/hooks";
import { useMutation } from "@tanstack/react-query";
import { useMemo, useState } from "react";
import { ask } from "../../api/http";
import { ApiProblem, explain } from "../../api/problem";
import { type Question, type Scenario, type Solution, type Strategy } from "../../api/types";
import { fullName, optionsOf, type Metric } from "../../server/metrics";
import { typedText, valueText, NO_RANGE, parseTyped } from "../../scenario/limits";
import { isRecording } from "../../lib/recording";
import { getAt, setAt } from "../../scenario/path";
import { type NumberField } from "../../scenario/schema";
import { useEdit, useLab, useReadOnly, useScenario, useView } from "../../lab/context";
import { useCatalogues } from "../../server/useCatalogues";
import { pointerOf, sweepFields, type SweepField, SEED } from "../../scenario/fields";
import { Fault } from "../../ui/Messages";
import { grouped } from "../../lib/order";
import { Entry, labelled } from "../../ui/Entry";
import { formatExact, formatInput, formatResult, prettyUnit } from "../../units/format";
import { curveOf, LimitChart } from "./LimitChart";
import ui from "../../ui/ui.module.css";
import { requiredOfThese, type Requirement } from "../../lab/requirements";
import { parseQuantity, unitBehind } from "../../units/quantity";

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

/** In place of a metric: all of the lab's requirements have to hold. */
const ALL = "requirements";

/** What a strategy is held to, and what its changes are against. */
interface Held {
  readonly requirements: readonly Requirement[];
  readonly baseline: string;
}

export interface SolveDraft {
  /** Its dotted name. */
  readonly field: string;
  readonly from: string;
  readonly to: string;
  readonly strategy: string;
  readonly metric: string;
  /** In the unit the metric is shown in. */
  readonly limit: string;
  /** How many are driven. */
  readonly roads: string;
}

/** A field, and the ends of the range that it opens with. */
type Range = Pick<SolveDraft, "field" | "from" | "to">;

/** Another field of the same kind in its place: an end that somebody has typed stays. */
export const otherField = (draft: Range, before: Range, after: Range): Range => ({
  field: after.field,
  from: draft.from === before.from ? after.from : draft.from,
  to: draft.to === before.to ? after.to : draft.to,
});

type Typed = "from" | "to" | "limit" | "roads";

/** What is asked, or what has to be changed first at each field. */
interface ParsedDraft {
  readonly question: Question | null;
  readonly wrong: Partial<Readonly<Record<Typed, string>>>;
  /** What does not depend on the limit: over which values, on how many roads. */
  readonly driven: Pick<Question, "range" | "roads"> | null;
}

const MOST_ROADS = 50;

const askable = ({ name, leaf }: SweepField): boolean => leaf.kind === "number" && name !== SEED;

/** `held` where all requirements have to hold, in place of a limit of the figure. */
export function readDraft(draft: SolveDraft, field: NumberField, figure: Metric | Held): ParsedDraft {
  const [from, to] = [parseTyped(field, draft.from), parseTyped(field, draft.to)];
  const roads = Number(draft.roads);
  const wrong: Partial<Record<Typed, string>> = {};
  if (!from.ok) wrong.from = from.message;
  if (!to.ok) wrong.to = to.message;
  if (from.ok && to.ok && from.value >= to.value) wrong.from = NO_RANGE;
  if (!Number.isInteger(roads) || roads < 1 || roads > MOST_ROADS)
    wrong.roads = `A whole number from 1 to ${MOST_ROADS}`;
  const isDriven = from.ok && to.ok && !wrong.from && !wrong.roads;
  const driven = isDriven ? { range: [from.value, to.value] as [number, number], roads } : null;
  const { field: name, strategy } = draft;
  const asked = "unit" in figure ? limitOf(draft, figure) : requirementsOf(strategy, figure);
  if (typeof asked === "string") wrong.limit = asked;
  if (!driven || typeof asked === "string" || Object.keys(wrong).length > 0) return { question: null, wrong, driven };
  return { question: { field: name, strategy, ...asked, ...driven }, wrong, driven };
}

type Asked = Pick<Question, "metric" | "limit" | "requirements" | "baseline"> | string;

/** What has to hold, or what is wrong with it. */
function limitOf({ metric, limit: typed }: SolveDraft, { unit, scale }: Metric): Asked {
  const limit = parseQuantity(typed, unit);
  if (typed.trim() === "")
    return prettyUnit(unit) === "" ? "Enter the limit" : `Enter the limit in ${prettyUnit(unit)}`;
  return limit.ok ? { metric, limit: Number((limit.value / scale).toPrecision(12)) } : limit.message;
}

function requirementsOf(strategy: string, { requirements, baseline }: Held): Asked {
  const asked = requiredOfThese(requirements, [strategy], baseline);
  return asked.requirements ? { ...asked, baseline } : "None of the lab’s requirements is about this strategy";
}

const NUMBER = String.raw`-?\d[\d.]*(?:e[+-]?\d+)?`;

/** The service's sentences, which are in the units of the API, in the names and units of the page. */
export function translateUnits(text: string, { name, title, leaf }: SweepField, figure: Metric | undefined): string {
  const named = (figure ? text.replaceAll(figure.key, fullName(figure)) : text).replaceAll(name, title);
  const converted = leaf.kind === "number" ? inUnit(named, leaf.unit, leaf.shown.unit, leaf.shown.scale) : named;
  return figure ? inUnit(converted, unitBehind(figure), figure.unit, figure.scale) : converted;
}

/** `0.08 to 0.1 m` and `0.1 m` in another unit. */
function inUnit(text: string, from: string, to: string, scale: number): string {
  if (from === "1") return text;
  const escaped = from.replace(/[.*+?^${}()|[\]\\]/g, String.raw`\$&`);
  const shown = (number: string) => formatInput(Number((Number(number) * scale).toPrecision(6)));
  return text.replace(
    new RegExp(`(${NUMBER})( to (${NUMBER}))? ${escaped}(?![\\w^/·])`, "g"),
    (_, first: string, more: string | undefined, last: string) =>
      `${shown(first)}${more === undefined ? "" : ` to ${shown(last)}`}\u00a0${prettyUnit(to)}`,
  );
}
