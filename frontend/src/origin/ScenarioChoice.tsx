/** Which scenario a page works on, what it has other than the paper, and how to choose another. */

import { Anchor, NativeSelect, Text } from "@mantine/core";
import { useState } from "react";
import type { Group } from "../editor/schema";
import { isNotFound } from "../api/problem";
import type { PageScenario } from "./origin";
import classes from "./origin.module.css";
import { otherThanPaper } from "./otherThanPaper";

interface Props {
  readonly source: PageScenario;
  readonly form: Group | undefined;
  readonly disabled?: boolean;
}

const runAddress = (id: string) => `/r/${encodeURIComponent(id)}`;

export function ScenarioChoice({ source: { origin, scenario, presets, error, choose }, form, disabled = false }: Props) {
  // A run that was once chosen stays on offer.
  const [run, setRun] = useState(origin.run);
  if (origin.run !== null && origin.run !== run) setRun(origin.run);
  const wrong = error === null ? undefined : isNotFound(error) ? "There is no run at this address: choose another scenario" : error.message;
  return (
    <div className={classes.choice}>
      <NativeSelect
        size="xs"
        label="Scenario"
        className={classes.select ?? ""}
        value={origin.run === null ? `preset ${origin.preset ?? ""}` : "run"}
        error={wrong}
        disabled={disabled || presets.length === 0}
        data={[
          ...(run === null ? [] : [{ value: "run", label: "From a run" }]),
          ...presets.map(({ id, label }) => ({ value: `preset ${id}`, label })),
        ]}
        onChange={({ currentTarget: { value } }) => choose(value === "run" ? { run, preset: null } : { run: null, preset: value.slice("preset ".length) })}
      />
      <Text size="xs" c="dimmed" className={classes.text ?? ""}>
        {scenario && form ? otherThanPaper(scenario, form) : "\u00a0"}{" "}
        <Anchor size="xs" underline="always" href={origin.run === null ? "/" : runAddress(origin.run)}>
          {origin.run === null ? "Make another in the lab" : "Change it in the lab"}
        </Anchor>
      </Text>
    </div>
  );
}
