/** How the strategies do where car, sensors and actuators are not what they believe: a study put together, followed, read. */

import { useQuery } from "@tanstack/react-query";
import { isNotFound } from "../../api/problem";
import { SweepList } from "../../features/sweep/SweepList";
import { usePageScenario } from "../../features/scenarioSource/scenarioSource";
import { ScenarioChoice } from "../../features/scenarioSource/ScenarioChoice";
import { useForm, useStrategies } from "../../server/useCatalogues";
import { defaultsQuery } from "./study";
import { StudyForm } from "./StudyForm";
import { Page } from "../../ui/Page";

export function RobustnessPage() {
  const source = usePageScenario();
  const defaults = useQuery(defaultsQuery);
  const [strategies, form] = [useStrategies(), useForm()];
  const lead =
    "The controllers assume one car, exact sensors and ideal actuators. Here every strategy drives the same random cars, whose sensors and actuators differ a little from that. How much of each lead is left? With the paper’s weights LV keeps its lead over LQR on the bump and loses it on the rough road; with the preset Robust LV it keeps both, as long as its own state is measured exactly.";
  // A scenario that is not there is said at its choice.
  const faults = [source.error && isNotFound(source.error) ? null : source.error, defaults.error];
  return (
    <Page title="Robustness" heading="Robustness" what="page" {...{ lead, faults }} heights={[28, 96, 440, 320]}>
      {defaults.data ? (
        <>
          <StudyForm
            defaults={defaults.data}
            strategies={strategies}
            form={form}
            scenario={source.scenario}
            head={<ScenarioChoice source={source} form={form} />}
          />
          <SweepList studies strategies={strategies} />
        </>
      ) : null}
    </Page>
  );
}
