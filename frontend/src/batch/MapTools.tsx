/** Whose map is drawn, compared with which strategy, and where it has a line. */

import { NativeSelect, TextInput } from "@mantine/core";
import { useState } from "react";
import type { Strategy } from "../api/types";
import { formatInput, prettyUnit } from "../units/format";
import { parseQuantity } from "../units/quantity";
import ui from "../ui/ui.module.css";
import classes from "./batch.module.css";
import type { ShownPlot } from "./shownPlot";
import { NONE, type BatchView } from "./view";

interface Props {
  readonly strategies: readonly Strategy[];
  readonly shown: ShownPlot;
  readonly onView: (change: Partial<BatchView>) => void;
}

export function MapTools({ strategies, shown, onView }: Props) {
  const { strategy, against } = shown;
  const options = strategies.map(({ id, label }) => ({ value: id, label }));
  return (
    <>
      <NativeSelect size="xs" label="Strategy" value={strategy} data={options} onChange={(event) => onView({ strategy: event.currentTarget.value, against: against ?? NONE, threshold: null })} />
      <NativeSelect
        size="xs"
        label="Change against"
        value={against ?? NONE}
        data={[{ value: NONE, label: "Nothing: its own values" }, ...options.filter(({ value }) => value !== strategy)]}
        onChange={(event) => onView({ against: event.currentTarget.value, threshold: null })}
      />
      <LineEntry key={`${shown.y.key} ${strategy} ${against ?? ""}`} {...{ shown, onView }} />
    </>
  );
}

function LineEntry({ shown: { threshold, mapUnit }, onView }: Pick<Props, "shown" | "onView">) {
  const [typed, setTyped] = useState(() => (threshold === null ? "" : formatInput(threshold)));
  const read = (text: string) => (text.trim() === "" ? null : parseQuantity(text, mapUnit));
  const parsed = read(typed);
  const change = (text: string) => {
    setTyped(text);
    const next = read(text);
    if (next === null || next.ok) onView({ threshold: next?.value ?? NONE });
  };
  return (
    <TextInput
      size="xs"
      className={classes.threshold ?? ""}
      label="Line at"
      inputMode="decimal"
      placeholder="no line"
      value={typed}
      error={parsed?.ok === false ? parsed.message : undefined}
      rightSection={<span className={ui.dim}>{prettyUnit(mapUnit)}</span>}
      rightSectionWidth={48}
      rightSectionPointerEvents="none"
      onChange={(event) => change(event.currentTarget.value)}
    />
  );
}
