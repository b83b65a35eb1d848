/** The fuzzy speed controller's sets and rules, edited beside the surface that they come to and the drive over it. */

import { Button, SegmentedControl, Skeleton, Text, useComputedColorScheme } from "@mantine/core";
import { useState } from "react";
import { useEdit, useReadOnly, useScenario } from "../../lab/context";
import type { ResultView } from "../../lab/resultView";
import { Chart } from "../../plots/Chart";
import { PALETTES } from "../../plots/palettes";
import { sameValue } from "../../scenario/path";
import { Fault } from "../../ui/Fault";
import { SidePanel } from "../../ui/SidePanel";
import {
  ruleBaseOf,
  TITLES,
  VARIABLES,
  withoutRuleBase,
  withRuleBase,
  type Rewritten,
  type RuleBase,
  type Variable,
} from "./ruleBase";
import { RulesTable } from "./RulesTable";
import { SetsEditor } from "./SetsEditor";
import { drivenIn, surfaceFigure } from "./surface";
import { useInference, type Inference } from "./useInference";

interface Props {
  readonly resultView: ResultView;
  readonly onClose: () => void;
}

export function FuzzyPanel({ resultView, onClose }: Props) {
  const inference = useInference();
  const [edit, scenario, readOnly] = [useEdit(), useScenario(), useReadOnly()];
  const isPaper = sameValue(withoutRuleBase(scenario), scenario);
  return (
    <SidePanel
      title="Fuzzy speed controller"
      data-testid="fuzzy"
      onClose={onClose}
      tools={
        !readOnly && (
          <Button
            size="compact-xs"
            variant="subtle"
            disabled={isPaper}
            aria-label="Back to the paper’s Table 1"
            onClick={() => edit.commit(withoutRuleBase(edit.newest()))}
          >
            Paper’s Table 1
          </Button>
        )
      }
    >
      {inference ? <Parts {...{ inference, resultView }} /> : <Skeleton height={420} />}
    </SidePanel>
  );
}

interface PartsProps {
  readonly inference: Inference;
  readonly resultView: ResultView;
}

function Parts({ inference: { answer, paper, errors }, resultView }: PartsProps) {
  const scenario = useScenario();
  const palette = PALETTES[useComputedColorScheme("light")];
  const [part, setPart] = useState<Variable | "rules">("speed_error");
  const base = ruleBaseOf(scenario, paper);
  const rewritten: Rewritten = (before, to) => withRuleBase(before, ruleBaseOf(before, paper), to);
  const driven = drivenIn(resultView);
  return (
    <>
      <Chart
        figure={surfaceFigure(answer, driven, palette)}
        height={230}
        label="Braking torque over distance and speed error, and the drive"
      />
      <Text size="xs" c="dimmed">
        Braking torque as a share of the greatest.{" "}
        {driven ? `The line is the drive of ${driven.label}.` : "No strategy that is shown slows down for the bump."}
      </Text>
      {errors.map(({ pointer, message }) => (
        <Fault key={pointer + message}>
          {placeOf(pointer, base)}
          {message}
        </Fault>
      ))}
      <SegmentedControl
        fullWidth
        aria-label="What is edited"
        value={part}
        data={[...VARIABLES.map((value) => ({ value, label: TITLES[value] })), { value: "rules", label: "Rules" }]}
        onChange={(value) => setPart(VARIABLES.find((variable) => variable === value) ?? "rules")}
      />
      {part === "rules" ? (
        <RulesTable {...{ base, rewritten }} />
      ) : (
        <SetsEditor key={part} variable={part} drawn={answer[part]} {...{ base, rewritten, errors }} />
      )}
    </>
  );
}

/** The set or rule that a pointer of the service leads to, in words. */
function placeOf(pointer: string, base: RuleBase): string {
  const variable = VARIABLES.find((each) => pointer.includes(each === "torque" ? "/output" : `/inputs/${each}`));
  const index = Number(/\d+/.exec(pointer)?.[0] ?? NaN);
  if (variable) return `${TITLES[variable]} ${base[variable][index]?.name ?? ""}: `;
  return pointer.includes("/rules/") ? `Rule ${index + 1}: ` : "";
}
