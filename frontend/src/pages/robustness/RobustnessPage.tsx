/** How the strategies do where car, sensors and actuators are not what they believe: a study put together, followed, read. */

import { useSuspenseQuery } from "@tanstack/react-query";
import { SweepList } from "../../features/sweep/SweepList";
import { usePageScenario } from "../../features/scenarioSource/scenarioSource";
import { ScenarioChoice } from "../../features/scenarioSource/ScenarioChoice";
import { uncertaintiesQuery } from "../../server/queries";
import { useForm, useStrategies } from "../../server/useCatalogues";
import { StudyForm } from "./StudyForm";
import { Page } from "../../ui/Page";

export function RobustnessPage() {
  const source = usePageScenario();
  const defaults = useSuspenseQuery(uncertaintiesQuery).data;
  const [strategies, form] = [useStrategies(), useForm()];
  const lead =
    "The controllers assume one car, exact sensors and ideal actuators. Here every strategy drives the same random cars, whose sensors and actuators differ a little from that. How much of each lead is left? With the paper’s weights LV keeps its lead over LQR on the bump and loses it on the rough road; with the preset Robust LV it keeps both, as long as its own state is measured exactly.";
  return (
    <Page title="Robustness" lead={lead}>
      <StudyForm
        defaults={defaults}
        strategies={strategies}
        form={form}
        scenario={source.scenario}
        head={<ScenarioChoice source={source} form={form} />}
      />
      <SweepList studies strategies={strategies} />
    </Page>
  );
}
