/** One swept field: its values in a grid, or its range. */

import { Chip, Group, SegmentedControl, Text, TextInput } from "@mantine/core";
import { optionTitle, type ChoiceField, type NumberField } from "../editor/schema";
import { prettyUnit } from "../units/format";
import { typedText } from "../editor/limits";
import { byRatio, spread, type FieldDraft, type Method } from "./draft";
import classes from "./sweep.module.css";
import ui from "../ui/ui.module.css";
import { EntryRow } from "../ui/EntryRow";

interface Props {
  readonly draft: FieldDraft;
  readonly method: Method;
  readonly error: string | undefined;
  readonly onChange: (change: Partial<FieldDraft>) => void;
  readonly onRemove: () => void;
}

export function SweptFieldRow({ draft, method, error, onChange, onRemove }: Props) {
  const { title, name, leaf } = draft.field;
  return (
    <EntryRow title={title} beside={<code className={classes.name}>{name}</code>} {...{ error, onRemove }}>
      {leaf.kind === "number" ? (
        <NumberValues field={leaf} {...{ draft, method, onChange }} />
      ) : (
        method === "grid" && <ChoiceValues field={leaf} {...{ draft, onChange }} />
      )}
    </EntryRow>
  );
}

type NumberProps = Pick<Props, "draft" | "method" | "onChange"> & { readonly field: NumberField };

function NumberValues({ field, draft, method, onChange }: NumberProps) {
  const unit = prettyUnit(field.shown.unit);
  const name = draft.field.title;
  const end = (key: "from" | "to", label: string) => (
    <TextInput
      size="xs"
      className={classes.end ?? ""}
      inputMode="decimal"
      label={label}
      aria-label={`${name}, ${label.toLowerCase()}`}
      value={draft[key]}
      {...(unit === "" ? {} : { rightSection: <span className={ui.dim}>{unit}</span>, rightSectionWidth: 48 })}
      rightSectionPointerEvents="none"
      onChange={(event) => onChange({ [key]: event.currentTarget.value })}
    />
  );
  const asList = method === "grid" && draft.by === "list";
  return (
    <div className={ui.entryValues}>
      {method === "grid" && (
        <SegmentedControl
          size="xs"
          className={classes.by ?? ""}
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
        <TextInput
          size="xs"
          className={classes.list ?? ""}
          label={unit === "" ? "Values" : `Values [${unit}]`}
          aria-label={`${name}, values`}
          placeholder={spread(field, ...field.soft, 3).map((value) => typedText(field, value)).join(", ")}
          value={draft.list}
          onChange={(event) => onChange({ list: event.currentTarget.value })}
        />
      ) : (
        <>
          {end("from", "From")}
          {end("to", "To")}
          {method === "grid" && (
            <TextInput
              size="xs"
              className={classes.count ?? ""}
              inputMode="numeric"
              label="Values"
              aria-label={`${name}, number of values`}
              value={draft.count}
              onChange={(event) => onChange({ count: event.currentTarget.value })}
            />
          )}
          {method === "grid" && byRatio(field) && <Text className={classes.note}>equal ratios</Text>}
        </>
      )}
    </div>
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
