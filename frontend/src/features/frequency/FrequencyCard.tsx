/** At which frequency does a control win, and how close is its loop to instability: live while a value is dragged. */

import { Group, NativeSelect, Stack, Text, useComputedColorScheme } from "@mantine/core";
import { useEffect, useMemo, useState } from "react";
import { ask } from "../../api/http";
import { isTransient, messageOf } from "../../api/problem";
import type { Catalogue, FrequencyAnswer, FrequencyRequest, Scenario, StrategyId } from "../../api/types";
import { createLatest } from "../../lib/latest";
import type { ResultView } from "../../lab/resultView";
import { PALETTES } from "../../plots/palettes";
import { StillSurface } from "../../plots/Surface";
import { Fault } from "../../ui/Fault";
import { prettyUnit } from "../../units/format";
import { frequencyFigures } from "./figures";
import classes from "./frequency.module.css";
import { BandsTable, MarginsTable } from "./tables";
import ui from "../../ui/ui.module.css";

type Output = NonNullable<FrequencyRequest["outputs"]>[number];
type Stage = NonNullable<FrequencyRequest["stage"]>;

const OUTPUTS: readonly Output[] = [
  "body_acceleration",
  "pitch_acceleration",
  "front_tyre_load",
  "rear_tyre_load",
  "front_deflection",
  "rear_deflection",
];
const STAGES: readonly Stage[] = ["cruise", "brake", "bump"];

interface Props {
  readonly resultView: ResultView;
  readonly catalogue: Catalogue;
}

export function FrequencyCard({ resultView, catalogue }: Props) {
  const palette = PALETTES[useComputedColorScheme("light")];
  const [signal, setSignal] = useState<Output>("body_acceleration");
  const [stage, setStage] = useState<Stage>("bump");
  const { shown, strategies, ids } = resultView;
  const { answer, fault } = useFrequency(shown.scenario, ids, stage);
  const entry = (key: string) => catalogue.signals.find((each) => each.key === key);
  const unit = prettyUnit(entry(signal)?.unit ?? "1");
  const figures = useMemo(
    () => (answer ? frequencyFigures(answer, strategies, signal, palette) : []),
    [answer, strategies, signal, palette],
  );
  return (
    <Stack gap="0.7rem" p="0 0.9rem 0.9rem" data-testid="frequencies" aria-busy={answer === null && fault === null}>
      <Group gap="0.6rem">
        <NativeSelect
          aria-label="Response from the road to"
          value={signal}
          data={OUTPUTS.map((key) => ({ value: key, label: entry(key)?.label ?? key }))}
          onChange={({ currentTarget }) => setSignal(OUTPUTS.find((key) => key === currentTarget.value) ?? signal)}
        />
        <NativeSelect
          aria-label="Driving stage"
          value={stage}
          data={STAGES.map((key) => ({ value: key, label: `stage ${key}` }))}
          onChange={({ currentTarget }) => setStage(STAGES.find((key) => key === currentTarget.value) ?? stage)}
        />
      </Group>
      <Text size="xs" c="dimmed">
        From the road’s height at the front axle, per metre, while no limit binds; held forces, actuator lag, estimator,
        ECU delay and preview are inside. Each stage is taken by itself, as if the car stayed in it: between stages
        there is no margin.
      </Text>
      {fault !== null && <Fault>{fault}</Fault>}
      <div className={classes.charts}>
        {figures.map(({ title, unit: own, figure }) => (
          <figure key={title} className={ui.figure}>
            <figcaption>
              {title}{" "}
              <span className={ui.dim}>
                [{title === "Gain" || title.startsWith("Spectrum") ? `${own}, 0 is 1 ${spectral(title, unit)}` : own}]
              </span>
            </figcaption>
            <div role="img" aria-label={`${title} over frequency`} style={{ height: 176 }}>
              <StillSurface figure={figure} />
            </div>
          </figure>
        ))}
      </div>
      {answer && (
        <>
          <BandsTable {...{ answer, strategies, signal, unit }} />
          <MarginsTable {...{ answer, strategies }} />
          {strategies.flatMap(({ id, label }) => {
            const reason = answer.strategies[id]?.reason;
            return reason ? [<Text key={id} size="xs">{`${label}: ${reason}.`}</Text>] : [];
          })}
        </>
      )}
    </Stack>
  );
}

const spectral = (title: string, unit: string) => (title === "Gain" ? `(${unit})/m` : `(${unit})²/Hz`);

interface Shown {
  readonly answer: FrequencyAnswer | null;
  readonly fault: string | null;
}

/** Of that scenario, one question at a time; what was overtaken is not shown. */
function useFrequency(scenario: Scenario, ids: readonly StrategyId[], stage: Stage): Shown {
  const [shown, setShown] = useState<Shown>({ answer: null, fault: null });
  const latest = useMemo(
    () =>
      createLatest<FrequencyRequest & { readonly scenario: Scenario }, FrequencyAnswer>({
        run: (body, signal) => ask("post", "/frequency", { body }, signal),
        onAnswer: (answer) => setShown({ answer, fault: null }),
        onError: (error) => {
          if (!isTransient(error)) setShown({ answer: null, fault: messageOf(error) });
        },
      }),
    [],
  );
  const names = ids.join(",");
  useEffect(() => {
    const strategies = [...new Set([...names.split(","), "passive"])];
    latest.request({ scenario, strategies, stage, outputs: null, frequencies: null });
  }, [latest, scenario, names, stage]);
  useEffect(() => latest.cancel, [latest]);
  return shown;
}
