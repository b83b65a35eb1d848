/** How the strategies do where car, sensors and actuators are not what they believe: a study put together, followed, read. */

import { useQuery } from "@tanstack/react-query";
import { isNotFound } from "../../api/problem";
import { SweepList } from "../../features/sweep/SweepList";
import { usePageScenario } from "../../features/scenarioSource/scenarioSource";
import { ScenarioChoice } from "../../features/scenarioSource/ScenarioChoice";
import { schemaQuery, strategiesQuery } from "../../server/queries";
import { defaultsQuery } from "./study";
import { StudyForm } from "./StudyForm";
import { Page } from "../../ui/Page";

export function RobustnessPage() {
  const source = usePageScenario();
  const defaults = useQuery(defaultsQuery);
  const strategies = useQuery(strategiesQuery);
  const form = useQuery(schemaQuery);
  const lead =
    "The controllers assume one car, exact sensors and ideal actuators. Here every strategy drives the same random cars, whose sensors and actuators differ a little from that. How much of each lead is left? With the paper’s weights LV keeps its lead over LQR on the bump and loses it on the rough road; with the preset Robust LV it keeps both, as long as its own state is measured exactly.";
  // A scenario that is not there is said at its choice.
  const faults = [
    source.error && isNotFound(source.error) ? null : source.error,
    defaults.error,
    strategies.error,
    form.error,
  ];
  return (
    <Page title="Robustness" heading="Robustness" what="page" {...{ lead, faults }} heights={[28, 96, 440, 320]}>
      {defaults.data && strategies.data && form.data ? (
        <>
          <StudyForm
            defaults={defaults.data}
            strategies={strategies.data}
            form={form.data}
            scenario={source.scenario}
            head={<ScenarioChoice source={source} form={form.data} />}
          />
          <SweepList studies strategies={strategies.data} />
        </>
      ) : null}
    </Page>
  );
}
