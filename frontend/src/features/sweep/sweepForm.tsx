/** What forms of sweeps have in common: entries, and what is ordered. */

import { useMemo } from "react";
import { ask } from "../../api/http";
import { withKey } from "../../api/jobs";
import type { Estimate, Scenario } from "../../api/types";
import { BATCH } from "../../jobs/useJob";
import { useJobForm, type DraftErrors, type FieldNameOf } from "../jobForm/jobForm";
import { useView } from "../../lab/context";
import { requiredOfThese } from "../../lab/requirements";
import { count, prettyUnit } from "../../units/format";
import { humanise, optionTitle, type ChoiceField, type NumberField } from "../../scenario/schema";
import { useCatalogues } from "../../server/useCatalogues";
import { choicesOf, Entry, EntryRow } from "../../ui/Entry";
import { readDraft, type SweepDraft, type FieldDraft, type Method, byRatio, spread } from "./draft";
import { Checkbox, Group, SegmentedControl, Chip } from "@mantine/core";
import { StrategyName } from "../../ui/StrategyKey";
import { Note } from "../../ui/Messages";
import ui from "../../ui/ui.module.css";
import { typedText } from "../../scenario/limits";

export function useSweep(draft: SweepDraft, scenario: Scenario, onSubmitted: () => void) {
  const { requirements, baseline } = useView();
  const { strategies } = draft;
  const parsed = useMemo(() => readDraft(draft), [draft]);
  return useJobForm({
    kind: "batch",
    parsed,
    bodyOf: (sweep) => ({ scenario, strategies, sweep, ...requiredOfThese(requirements, strategies, baseline) }),
    fieldNameOf: sweepFieldName(draft.fields.map(({ field }) => field.name)),
    estimate: (body, signal) => ask("post", "/batches", { body: { ...body, dry_run: true } }, signal),
    onSubmitted,
    submit: async (body, keyOf) => ({
      to: BATCH.page,
      params: { id: (await ask("post", "/batches", { body, ...withKey(keyOf(body)) })).id },
    }),
  });
}

export const amountOf =
  (strategies: number) =>
  ({ total, points }: Estimate) =>
    `${count(total, "run")} (${count(points, "point")} × ${count(strategies, "strategy", "strategies")})`;

export const notesOf = ({ contradictory, total }: Estimate): readonly string[] =>
  contradictory === 0
    ? []
    : [
        `In ${contradictory === total ? "all" : count(contradictory, "run")} of them values contradict each other: these runs fail and say why`,
      ];

/** Where the server's errors about a sweep belong. */
export const sweepFieldName =
  (names: readonly string[]): FieldNameOf =>
  ([root, form, ...rest]) => {
    if (root === "strategies") return "strategies";
    if (root !== "sweep") return null;
    const name = form === "grid" ? rest[0] : rest[0] === "ranges" ? rest[1] : rest[0];
    return name !== undefined && (names.includes(name) || name === "samples" || name === "seed") ? name : null;
  };

interface EntriesProps<Key extends "strategies" | "samples" | "seed"> {
  readonly draft: Pick<SweepDraft, Key>;
  readonly errors: DraftErrors;
  readonly onChange: (change: Partial<Pick<SweepDraft, Key>>) => void;
}

/** Under which strategies each point runs. */
export function StrategyChoice({ draft, errors, onChange }: EntriesProps<"strategies">) {
  const { strategies } = useCatalogues();
  return (
    <Checkbox.Group
      label="Strategies"
      size="xs"
      value={[...draft.strategies]}
      error={errors.strategies}
      onChange={(ids) => onChange({ strategies: strategies.flatMap(({ id }) => (ids.includes(id) ? [id] : [])) })}
    >
      <Group gap="0.5rem 1.2rem" align="stretch" mt="0.4rem">
        {strategies.map((strategy) => (
          <Checkbox key={strategy.id} value={strategy.id} label={<StrategyName strategy={strategy} />} />
        ))}
      </Group>
    </Checkbox.Group>
  );
}

interface CubeProps extends EntriesProps<"samples" | "seed"> {
  readonly w: number | string;
  /** Of both. */
  readonly descriptions?: readonly [string, string];
}

/** How many points a Latin hypercube has, and which. */
export function CubeEntries({ draft, errors, onChange, w, descriptions = ["", ""] }: CubeProps) {
  return (
    <Group gap="0.8rem 1.2rem" align="flex-start">
      {(["samples", "seed"] as const).map((key, index) => (
        <Entry
          key={key}
          w={w}
          label={humanise(key)}
          description={descriptions[index]}
          inputMode="numeric"
          value={draft[key]}
          error={errors[key]}
          onType={(text) => onChange({ [key]: text })}
        />
      ))}
    </Group>
  );
}

interface RowProps {
  readonly draft: FieldDraft;
  readonly method: Method;
  readonly error: string | undefined;
  readonly onChange: (change: Partial<FieldDraft>) => void;
  readonly onRemove: () => void;
}

export function SweptFieldRow({ draft, method, error, onChange, onRemove }: RowProps) {
  const { title, name, leaf } = draft.field;
  return (
    <EntryRow title={title} beside={<code className={ui.dim}>{name}</code>} {...{ error, onRemove }}>
      {leaf.kind === "number" ? (
        <NumberValues field={leaf} {...{ draft, method, onChange }} />
      ) : (
        method === "grid" && <ChoiceValues field={leaf} {...{ draft, onChange }} />
      )}
    </EntryRow>
  );
}

type NumberProps = Pick<RowProps, "draft" | "method" | "onChange"> & { readonly field: NumberField };

function NumberValues({ field, draft, method, onChange }: NumberProps) {
  const unit = prettyUnit(field.shown.unit);
  const name = draft.field.title;
  const end = (key: "from" | "to", label: string) => (
    <Entry
      w="7.3rem"
      label={label}
      aria-label={`${name}, ${label.toLowerCase()}`}
      value={draft[key]}
      unit={field.shown.unit}
      onType={(text) => onChange({ [key]: text })}
    />
  );
  const asList = method === "grid" && draft.by === "list";
  return (
    <Group gap="0.4rem 0.7rem" align="flex-end" mt="0.3rem">
      {method === "grid" && (
        <SegmentedControl
          flex={{ base: "1 1 100%", xs: "none" }}
          aria-label={`${name}: values by`}
          value={draft.by}
          data={choicesOf<FieldDraft["by"]>({ steps: "From, to", list: "List" })}
          onChange={(by) => onChange({ by })}
        />
      )}
      {asList ? (
        <Entry
          flex="1 1 14rem"
          inputMode="text"
          label={unit === "" ? "Values" : `Values [${unit}]`}
          aria-label={`${name}, values`}
          placeholder={spread(field, ...field.soft, 3)
            .map((value) => typedText(field, value))
            .join(", ")}
          value={draft.list}
          onType={(list) => onChange({ list })}
        />
      ) : (
        <>
          {end("from", "From")}
          {end("to", "To")}
          {method === "grid" && (
            <Entry
              w="5rem"
              inputMode="numeric"
              label="Values"
              aria-label={`${name}, number of values`}
              value={draft.count}
              onType={(count) => onChange({ count })}
            />
          )}
          {method === "grid" && byRatio(field) && <Note pb="0.4rem">equal ratios</Note>}
        </>
      )}
    </Group>
  );
}

type ChoiceProps = Pick<RowProps, "draft" | "onChange"> & { readonly field: ChoiceField };

function ChoiceValues({ field, draft, onChange }: ChoiceProps) {
  return (
    <Chip.Group multiple value={[...draft.options]} onChange={(options) => onChange({ options })}>
      <Group gap="xs" mt={6}>
        {field.options.map((option) => (
          <Chip key={option} size="xs" value={option}>
            {optionTitle(option)}
          </Chip>
        ))}
      </Group>
    </Chip.Group>
  );
}
