/** Finds a field of the scenario by its title or its dotted name. */

import { Group } from "@mantine/core";
import { Finder } from "../../ui/Finder";
import { prettyUnit } from "../../units/format";
import { draftField, type FieldDraft } from "./draft";
import { TOGETHER, type SweepField } from "../../scenario/fields";
import classes from "./sweep.module.css";
import ui from "../../ui/ui.module.css";

interface Props {
  readonly fields: readonly SweepField[];
  readonly numbersOnly: boolean;
  readonly error: string | undefined;
  readonly onPick: (picked: readonly FieldDraft[]) => void;
}

export function FieldPicker({ fields, numbersOnly, error, onPick }: Props) {
  const offered = fields.filter(({ leaf }) => !numbersOnly || leaf.kind === "number");
  const together = TOGETHER.flatMap(({ title, names }) => {
    const [first, ...linked] = names.flatMap((name) => offered.find((field) => field.name === name) ?? []);
    return first && linked.length === names.length - 1 ? [{ title, draft: { ...draftField(first), linked } }] : [];
  });
  const sections = [...new Set(offered.map(({ section }) => section))];
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
        ...sections.map((section) => ({
          group: section,
          items: offered
            .filter((field) => field.section === section)
            .map(({ name, title }) => ({ value: name, label: `${title} ${name} ${section}` })),
        })),
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
      <code className={classes.name}>{name}</code>
    </Group>
  );
}
