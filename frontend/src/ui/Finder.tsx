/** Finds something by a part of its name and hands it on; it stays empty itself. */

import { Select, type SelectProps } from "@mantine/core";
import { useState } from "react";

interface Props extends Omit<SelectProps, "onChange" | "value"> {
  readonly onPick: (value: string) => void;
}

export function Finder({ onPick, ...props }: Props) {
  const [search, setSearch] = useState("");
  return (
    <Select
      size="xs"
      searchable
      value={null}
      searchValue={search}
      onSearchChange={setSearch}
      maxDropdownHeight={300}
      {...props}
      onChange={(value) => {
        if (value === null) return;
        setSearch("");
        onPick(value);
      }}
    />
  );
}
