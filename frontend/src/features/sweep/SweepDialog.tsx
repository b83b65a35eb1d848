/** Puts a sweep together: which fields, from where to where, under which strategies; says what it costs before it starts. */

import { Button, Group, Modal, SegmentedControl, Stack, Text } from "@mantine/core";
import { useMediaQuery } from "@mantine/hooks";
import { useMemo } from "react";
import type { Batch, Strategy } from "../../api/types";
import type { Group as Form } from "../../scenario/schema";
import { SweepList } from "./SweepList";
import { draftField, restoreSweep, type FieldDraft, type Method, type SweepDraft } from "./draft";
import { linkable, sweepFields, TOGETHER, type SweepField } from "../../scenario/fields";
import { StrategyChoice } from "./StrategyChoice";
import { SweptFieldRow } from "./SweptFieldRow";
import { amountOf, notesOf, useSweep } from "./useSweep";
import { useLab, useScenario, useView } from "../../lab/context";
import { requiredOfThese } from "../../lab/requirements";
import { isRecording } from "../../lib/recording";
import { useDraft } from "../../lib/useDraft";
import { StartFoot } from "../jobForm/StartFoot";
import { grouped } from "../../lib/order";
import { Entry, Finder } from "../../ui/Entry";
import { Problems, Note } from "../../ui/Messages";
import { count, prettyUnit } from "../../units/format";
import ui from "../../ui/ui.module.css";

interface Props {
  /** Whose scenario it is over; without one the form's. */
  readonly batch: Batch | undefined;
  readonly form: Form;
  readonly strategies: readonly Strategy[];
  readonly onClose: () => void;
}

const FIRST_FIELD = "road.bump.height";

export function SweepDialog({ batch, form: schema, strategies, onClose }: Props) {
  const edited = useScenario();
  const scenario = batch?.scenario ?? edited;
  const switchedOn = useLab((state) => batch?.strategies ?? state.strategies);
  const fields = useMemo(() => sweepFields(schema), [schema]);
  const narrow = useMediaQuery("(max-width: 47.99em)", false, { getInitialValueInEffect: false });
  const form = useDraft<SweepDraft>({
    name: "sweep",
    initial: () => ({
      method: "grid",
      fields: fields.filter(({ name }) => name === FIRST_FIELD).map(draftField),
      samples: "200",
      seed: "0",
      strategies: switchedOn.filter((id) => !isRecording(id)),
    }),
    restore: (stored) => restoreSweep(stored, fields),
  });
  const { draft, setDraft } = form;
  const patch = (change: Partial<SweepDraft>) => setDraft({ ...draft, ...change });
  const patchField = (name: string, change: Partial<FieldDraft>) =>
    patch({ fields: draft.fields.map((each) => (each.field.name === name ? { ...each, ...change } : each)) });
  const free = fields.filter(
    (field) => !draft.fields.some((each) => each.field === field || each.linked.includes(field)),
  );
  const submission = useSweep(draft, scenario, form.forget);
  const { errors, general } = submission;
  const held = requiredOfThese(useView().requirements, draft.strategies, "").requirements ?? [];

  return (
    <Modal opened onClose={onClose} title="Sweep" size="xl" fullScreen={narrow} classNames={{ body: ui.stack ?? "" }}>
      <Text c="dimmed">
        Runs many variants of {batch ? "this sweep’s scenario" : "the scenario in the form"}, each with every strategy
        selected here. Fields that are not swept keep their values.
      </Text>
      <Group gap="sm">
        <SegmentedControl
          aria-label="How values are combined"
          value={draft.method}
          data={[
            { value: "grid" satisfies Method, label: "Grid" },
            { value: "hypercube" satisfies Method, label: "Latin hypercube" },
          ]}
          onChange={(method) => patch({ method })}
        />
        <Note>
          {draft.method === "grid"
            ? "Every combination of the values."
            : "Random points, evenly spread over the ranges."}
        </Note>
      </Group>
      <Stack gap="0.6rem">
        {draft.fields.map((each) => (
          <SweptFieldRow
            key={each.field.name}
            draft={each}
            method={draft.method}
            error={errors[each.field.name]}
            onChange={(change) => patchField(each.field.name, change)}
            linkable={linkable(each, free)}
            onRemove={() => patch({ fields: draft.fields.filter(({ field }) => field !== each.field) })}
          />
        ))}
        <FieldPicker
          fields={free}
          numbersOnly={draft.method === "hypercube"}
          error={errors.fields}
          onPick={(picked) => patch({ fields: [...draft.fields, ...picked] })}
        />
      </Stack>
      {draft.method === "hypercube" && (
        <Group gap="md" align="flex-start">
          <Entry
            w={120}
            label="Samples"
            inputMode="numeric"
            value={draft.samples}
            error={errors.samples}
            onType={(samples) => patch({ samples })}
          />
          <Entry
            w={120}
            label="Seed"
            inputMode="numeric"
            value={draft.seed}
            error={errors.seed}
            onType={(seed) => patch({ seed })}
          />
        </Group>
      )}
      <StrategyChoice
        strategies={strategies}
        selected={draft.strategies}
        error={errors.strategies}
        onChange={(ids) => patch({ strategies: ids })}
      />
      <Problems messages={general} />
      <details className={ui.more}>
        <summary>Earlier sweeps</summary>
        <SweepList strategies={strategies} />
      </details>
      <StartFoot
        {...{ submission, draft: form }}
        amount={amountOf(draft.strategies.length)}
        notes={(estimate) => [
          ...notesOf(estimate),
          ...(held.length > 0 ? [`Its runs are held to ${count(held.length, "requirement")} of the lab`] : []),
        ]}
      >
        <Button size="sm" onClick={onClose}>
          Cancel
        </Button>
      </StartFoot>
    </Modal>
  );
}

interface FieldPickerProps {
  readonly fields: readonly SweepField[];
  readonly numbersOnly: boolean;
  readonly error: string | undefined;
  readonly onPick: (picked: readonly FieldDraft[]) => void;
}

/** Finds a field of the scenario by its title or its dotted name. */
function FieldPicker({ fields, numbersOnly, error, onPick }: FieldPickerProps) {
  const offered = fields.filter(({ leaf }) => !numbersOnly || leaf.kind === "number");
  const together = TOGETHER.flatMap(({ title, names }) => {
    const [first, ...linked] = names.flatMap((name) => offered.find((field) => field.name === name) ?? []);
    return first && linked.length === names.length - 1 ? [{ title, draft: { ...draftField(first), linked } }] : [];
  });
  return (
    <Finder
      label="Add a field"
      placeholder="Height, road.bump.height, spring…"
      error={error}
      nothingFoundMessage="No field of that name"
      // The label is what is searched: it holds the section and both names.
      data={[
        {
          group: "Together",
          items: together.map(({ title, draft }) => ({ value: title, label: `${title}: ${namesOf(draft)}` })),
        },
        ...grouped(
          offered,
          ({ section }) => section,
          ({ name, title, section }) => ({ value: name, label: `${title} ${name} ${section}` }),
        ),
      ].filter(({ items }) => items.length > 0)}
      renderOption={({ option }) => {
        const field = offered.find(({ name }) => name === option.value);
        return field ? <Option field={field} /> : option.label;
      }}
      onPick={(name) =>
        onPick([
          ...offered.filter((field) => field.name === name).map(draftField),
          ...together.filter(({ title }) => title === name).map(({ draft }) => draft),
        ])
      }
    />
  );
}

const namesOf = ({ field, linked }: FieldDraft) =>
  [field, ...linked].map(({ title }) => title.toLowerCase()).join(" = ");

function Option({ field: { title, name, leaf } }: { readonly field: SweepField }) {
  const unit = leaf.kind === "number" ? prettyUnit(leaf.shown.unit) : "";
  return (
    <Group component="span" gap="0 0.8rem" align="baseline" justify="space-between" w="100%">
      <span>
        {title} {unit !== "" && <span className={ui.dim}>{unit}</span>}
      </span>
      <code className={ui.dim}>{name}</code>
    </Group>
  );
}
