/** Finds a figure of a run by its name. */

import { Select } from "@mantine/core";
import { useState } from "react";
import { fullName, type Figure } from "../batch/figures";
import classes from "./tuner.module.css";

interface Props {
  readonly label: string;
  readonly figures: readonly Figure[];
  /** What stands before the figures. */
  readonly first?: readonly { readonly value: string; readonly label: string }[];
  readonly error?: string | undefined;
  readonly onPick: (key: string) => void;
}

export function FigureSelect({ label, figures, first = [], error, onPick }: Props) {
  const [search, setSearch] = useState("");
  const groups = [...new Set(figures.map(({ group }) => group))];
  return (
    <Select
      size="xs"
      className={classes.select ?? ""}
      label={label}
      placeholder="Name of a figure…"
      searchable
      value={null}
      searchValue={search}
      onSearchChange={setSearch}
      error={error}
      nothingFoundMessage="No figure of that name"
      maxDropdownHeight={300}
      data={[
        ...(first.length > 0 ? [{ group: "Sums over the passive car’s", items: [...first] }] : []),
        ...groups.map((group) => ({
          group,
          items: figures.filter((figure) => figure.group === group).map((figure) => ({ value: figure.key, label: fullName(figure) })),
        })),
      ]}
      onChange={(key) => {
        if (key === null) return;
        setSearch("");
        onPick(key);
      }}
    />
  );
}
