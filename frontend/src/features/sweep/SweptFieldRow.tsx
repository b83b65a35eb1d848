/** One swept field: its values in a grid, or its range. */

import { Chip, Group, MultiSelect, SegmentedControl, Text } from "@mantine/core";
import { optionTitle, type ChoiceField, type NumberField } from "../../scenario/schema";
import { prettyUnit } from "../../units/format";
import { typedText } from "../../scenario/limits";
import { byRatio, spread, type FieldDraft, type Method } from "./draft";
import type { SweepField } from "../../scenario/fields";
import { Entry, EntryRow } from "../../ui/Entry";
import ui from "../../ui/ui.module.css";

interface Props {
  readonly draft: FieldDraft;
  readonly method: Method;
  readonly error: string | undefined;
  /** Fields that may take its value. */
  readonly linkable: readonly SweepField[];
  readonly onChange: (change: Partial<FieldDraft>) => void;
  readonly onRemove: () => void;
}

export function SweptFieldRow({ draft, method, error, linkable, onChange, onRemove }: Props) {
  const { title, name, leaf } = draft.field;
  return (
    <EntryRow title={title} beside={<code className={ui.dim}>{name}</code>} {...{ error, onRemove }}>
      {leaf.kind === "number" ? (
        <NumberValues field={leaf} {...{ draft, method, onChange }} />
      ) : (
        method === "grid" && <ChoiceValues field={leaf} {...{ draft, onChange }} />
      )}
      {(linkable.length > 0 || draft.linked.length > 0) && <Links {...{ draft, linkable, onChange }} />}
    </EntryRow>
  );
}

type NumberProps = Pick<Props, "draft" | "method" | "onChange"> & { readonly field: NumberField };

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
          data={[
            { value: "steps" satisfies FieldDraft["by"], label: "From, to" },
            { value: "list" satisfies FieldDraft["by"], label: "List" },
          ]}
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
          {method === "grid" && byRatio(field) && (
            <Text pb="0.4rem" fz="xs" c="dimmed">
              equal ratios
            </Text>
          )}
        </>
      )}
    </Group>
  );
}

/** Further fields that take the same value at each point. */
function Links({ draft: { field, linked }, linkable, onChange }: Pick<Props, "draft" | "linkable" | "onChange">) {
  const offered = [...linked, ...linkable];
  return (
    <MultiSelect
      maw="24rem"
      mt="0.4rem"
      aria-label={`${field.title}, also sets`}
      placeholder={linked.length === 0 ? "Also sets the same value of …" : ""}
      data={offered.map(({ name, title }) => ({ value: name, label: title }))}
      value={linked.map(({ name }) => name)}
      onChange={(names) => onChange({ linked: offered.filter(({ name }) => names.includes(name)) })}
    />
  );
}

type ChoiceProps = Pick<Props, "draft" | "onChange"> & { readonly field: ChoiceField };

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
