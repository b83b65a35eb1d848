/** Finds a figure of a run by its name. */

import { Select } from "@mantine/core";
import { useState } from "react";
import { optionsOf, type Figure } from "../batch/figures";
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
  return (
    <Select
      size="xs"
      className={classes.select ?? ""}
      label={label}
      placeholder="Name of a metric…"
      searchable
      value={null}
      searchValue={search}
      onSearchChange={setSearch}
      error={error}
      nothingFoundMessage="No metric of that name"
      maxDropdownHeight={300}
      data={[
        ...(first.length > 0 ? [{ group: "Sums over the passive car’s", items: [...first] }] : []),
        ...optionsOf(figures),
      ]}
      onChange={(key) => {
        if (key === null) return;
        setSearch("");
        onPick(key);
      }}
    />
  );
}
