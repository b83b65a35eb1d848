/** Finds a field of the scenario by its title or its dotted name. */

import { Select } from "@mantine/core";
import { useState } from "react";
import { prettyUnit } from "../units/format";
import type { SweepField } from "./fields";
import classes from "./sweep.module.css";
import ui from "../ui/ui.module.css";

interface Props {
  readonly fields: readonly SweepField[];
  readonly numbersOnly: boolean;
  readonly error: string | undefined;
  readonly onPick: (field: SweepField) => void;
}

export function FieldPicker({ fields, numbersOnly, error, onPick }: Props) {
  const [search, setSearch] = useState("");
  const offered = fields.filter(({ leaf }) => !numbersOnly || leaf.kind === "number");
  const sections = [...new Set(offered.map(({ section }) => section))];
  return (
    <Select
      size="xs"
      label="Add a field"
      placeholder="Height, road.bump.height, spring…"
      searchable
      value={null}
      searchValue={search}
      onSearchChange={setSearch}
      error={error}
      nothingFoundMessage="No field of that name"
      maxDropdownHeight={280}
      // The label is what is searched: it holds the section and both names.
      data={sections.map((section) => ({
        group: section,
        items: offered.filter((field) => field.section === section).map(({ name, title }) => ({ value: name, label: `${title} ${name} ${section}` })),
      }))}
      renderOption={({ option }) => {
        const field = offered.find(({ name }) => name === option.value);
        return field && <Option field={field} />;
      }}
      onChange={(name) => {
        const field = offered.find((candidate) => candidate.name === name);
        if (!field) return;
        setSearch("");
        onPick(field);
      }}
    />
  );
}

function Option({ field: { title, name, leaf } }: { readonly field: SweepField }) {
  const unit = leaf.kind === "number" ? prettyUnit(leaf.shown.unit) : "";
  return (
    <span className={classes.option}>
      <span>
        {title} {unit !== "" && <span className={ui.dim}>{unit}</span>}
      </span>
      <code className={classes.name}>{name}</code>
    </span>
  );
}
