/** Which scenario a page works on, what it has other than the paper, and how to choose another. */

import { NativeSelect, Text } from "@mantine/core";
import { useState } from "react";
import type { Group } from "../editor/schema";
import { isNotFound } from "../api/problem";
import type { PageScenario } from "./origin";
import { LabLink } from "../shell/LabLink";
import classes from "./origin.module.css";
import { otherThanPaper } from "./otherThanPaper";

interface Props {
  readonly source: PageScenario;
  readonly form: Group | undefined;
  readonly disabled?: boolean;
}

export function ScenarioChoice({ source: { origin, scenario, presets, error, choose }, form, disabled = false }: Props) {
  // A run that was once chosen stays on offer.
  const [run, setRun] = useState(origin.run);
  if (origin.run !== undefined && origin.run !== run) setRun(origin.run);
  const wrong = error === null ? undefined : isNotFound(error) ? "There is no run at this address: choose another scenario" : error.message;
  return (
    <div className={classes.choice}>
      <NativeSelect
        size="xs"
        label="Scenario"
        className={classes.select ?? ""}
        value={origin.run === undefined ? `preset ${origin.preset ?? ""}` : "run"}
        error={wrong}
        disabled={disabled || presets.length === 0}
        data={[
          ...(run === undefined ? [] : [{ value: "run", label: "From a run" }]),
          ...presets.map(({ id, label }) => ({ value: `preset ${id}`, label })),
        ]}
        onChange={({ currentTarget: { value } }) => choose(value === "run" && run !== undefined ? { run } : { preset: value.slice("preset ".length) })}
      />
      <Text size="xs" c="dimmed" className={classes.text ?? ""}>
        {scenario && form ? otherThanPaper(scenario, form) : "\u00a0"}{" "}
        <LabLink run={origin.run}>{origin.run === undefined ? "Create another in the lab" : "Change it in the lab"}</LabLink>
      </Text>
    </div>
  );
}
