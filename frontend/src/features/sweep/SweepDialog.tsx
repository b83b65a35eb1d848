/** Puts a sweep together: which fields, from where to where, under which strategies; says what it costs before it starts. */

import { Button, Group, Modal, SegmentedControl, Stack, Text } from "@mantine/core";
import { useMediaQuery } from "@mantine/hooks";
import { useMemo } from "react";
import type { Batch } from "../../api/types";
import { draftField, restoreSweep, type FieldDraft, type Method, type SweepDraft } from "./draft";
import { sweepFields, type SweepField } from "../../scenario/fields";
import { amountOf, CubeEntries, notesOf, StrategyChoice, useSweep, SweptFieldRow } from "./sweepForm";
import { useLab, useScenario, useView } from "../../lab/context";
import { requiredOfThese } from "../../lab/requirements";
import { isRecording } from "../../lib/recording";
import { useForm } from "../../server/useCatalogues";
import { useDraft } from "../../lib/useDraft";
import { grouped } from "../../lib/order";
import { StartFoot } from "../jobForm/jobForm";
import { choicesOf, Finder } from "../../ui/Entry";
import { Problems, Note } from "../../ui/Messages";
import { count } from "../../units/format";
import { NameWithUnit } from "../../ui/StrategyKey";
import ui from "../../ui/ui.module.css";

interface Props {
  /** Whose scenario it is over; without one the form's. */
  readonly batch: Batch | undefined;
  readonly onClose: () => void;
}

const FIRST_FIELD = "road.bump.height";

const METHODS = choicesOf<Method>({ grid: "Grid", hypercube: "Latin hypercube" });
const EXPLAINED: Readonly<Record<Method, string>> = {
  grid: "Every combination of the values.",
  hypercube: "Random points, evenly spread over the ranges.",
};

export function SweepDialog({ batch, onClose }: Props) {
  const schema = useForm();
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
  const { draft, patch } = form;
  const free = fields.filter((field) => !draft.fields.some((each) => each.field === field));
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
          data={METHODS}
          onChange={(method) => patch({ method })}
        />
        <Note>{EXPLAINED[draft.method]}</Note>
      </Group>
      <Stack gap="0.6rem">
        {draft.fields.map((each) => (
          <SweptFieldRow
            key={each.field.name}
            draft={each}
            method={draft.method}
            error={errors[each.field.name]}
            onChange={(change) =>
              patch({ fields: draft.fields.map((other) => (other === each ? { ...each, ...change } : other)) })
            }
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
      {draft.method === "hypercube" && <CubeEntries {...{ draft, errors }} w={120} onChange={patch} />}
      <StrategyChoice {...{ draft, errors }} onChange={patch} />
      <Problems messages={general} />
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
  return (
    <Finder
      label="Add a field"
      placeholder="Height, road.bump.height, spring…"
      error={error}
      nothingFoundMessage="No field of that name"
      // The label is what is searched: it holds the section and both names.
      data={grouped(
        offered,
        ({ section }) => section,
        ({ name, title, section }) => ({ value: name, label: `${title} ${name} ${section}` }),
      )}
      renderOption={({ option }) => {
        const field = offered.find(({ name }) => name === option.value);
        return field ? <Option field={field} /> : option.label;
      }}
      onPick={(name) => onPick(offered.filter((field) => field.name === name).map(draftField))}
    />
  );
}

function Option({ field: { title, name, leaf } }: { readonly field: SweepField }) {
  return (
    <Group component="span" gap="0 0.8rem" align="baseline" justify="space-between" w="100%">
      <span>
        <NameWithUnit name={title} unit={leaf.kind === "number" ? leaf.shown.unit : "1"} />
      </span>
      <code className={ui.dim}>{name}</code>
    </Group>
  );
}
