/** Whose map is drawn, compared with which strategy, and where it has a line. */

import { useState } from "react";
import { formatInput } from "../../units/format";
import { parseQuantity } from "../../units/quantity";
import { Choice, Entry, labelled } from "../../ui/Entry";
import classes from "./sweep.module.css";
import { NONE } from "./view";
import type { SweepParts } from "./props";

type Props = Pick<SweepParts, "strategies" | "shown" | "onView">;

export function MapTools({ strategies, shown, onView }: Props) {
  const { strategy, against } = shown;
  const options = labelled(strategies);
  return (
    <>
      <Choice
        label="Strategy"
        value={strategy}
        data={options}
        onPick={(id) => onView({ strategy: id, against: against ?? NONE, threshold: null })}
      />
      <Choice
        label="Change against"
        value={against ?? NONE}
        data={[{ value: NONE, label: "Nothing: its own values" }, ...options.filter(({ value }) => value !== strategy)]}
        onPick={(id) => onView({ against: id, threshold: null })}
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
    <Entry
      className={classes.threshold}
      label="Line at"
      placeholder="no line"
      value={typed}
      unit={mapUnit}
      error={parsed?.ok === false ? parsed.message : undefined}
      onType={change}
    />
  );
}
