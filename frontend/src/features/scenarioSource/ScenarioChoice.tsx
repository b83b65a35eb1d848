/** Which scenario a page works on, what it has other than the paper, and how to choose another. */

import { Group as Row } from "@mantine/core";
import { useState } from "react";
import type { Group } from "../../scenario/schema";
import { isNotFound } from "../../api/problem";
import { useItems } from "../../scenario/library";
import type { ScenarioSource, PageScenario } from "./scenarioSource";
import { otherThanPaper } from "./otherThanPaper";
import { Note } from "../../ui/Messages";
import { Choice } from "../../ui/Entry";
import { LabLink } from "../../ui/openInLab";

const valueOf = ({ run, own, preset = "" }: ScenarioSource) =>
  run !== undefined ? "run" : own !== undefined ? `own ${own}` : `preset ${preset}`;

function originOf(value: string, run: string | undefined): ScenarioSource {
  if (value === "run" && run !== undefined) return { run };
  return value.startsWith("own ") ? { own: value.slice("own ".length) } : { preset: value.slice("preset ".length) };
}

interface Props {
  readonly source: PageScenario;
  readonly form: Group | undefined;
  readonly disabled?: boolean;
}

export function ScenarioChoice({
  source: { origin, scenario, presets, error, choose },
  form,
  disabled = false,
}: Props) {
  // A run that was once chosen stays on offer.
  const [run, setRun] = useState(origin.run);
  if (origin.run !== undefined && origin.run !== run) setRun(origin.run);
  const own = useItems("scenario");
  const wrong =
    error === null
      ? undefined
      : isNotFound(error) && origin.run !== undefined
        ? "There is no run at this address: choose another scenario"
        : error.message;
  return (
    <Row gap="0.3rem 0.9rem" align="flex-end">
      <Choice
        label="Scenario"
        flex="0 1 17rem"
        miw="11rem"
        value={valueOf(origin)}
        error={wrong}
        disabled={disabled || presets.length === 0}
        data={[
          ...(run === undefined ? [] : [{ value: "run", label: "From a run" }]),
          ...(error !== null && origin.own !== undefined ? [{ value: valueOf(origin), label: origin.own }] : []),
          ...presets.map(({ id, label }) => ({ value: valueOf({ preset: id }), label })),
          ...(own.length > 0
            ? [
                {
                  group: "Your scenarios",
                  items: own.map(({ name }) => ({ value: valueOf({ own: name }), label: name })),
                },
              ]
            : []),
        ]}
        onPick={(value) => choose(originOf(value, run))}
      />
      <Note flex="1 1 16rem" pb="0.35rem">
        {scenario && form ? otherThanPaper(scenario, form) : "\u00a0"}{" "}
        <LabLink run={origin.run}>
          {origin.run === undefined ? "Create another in the lab" : "Change it in the lab"}
        </LabLink>
      </Note>
    </Row>
  );
}
