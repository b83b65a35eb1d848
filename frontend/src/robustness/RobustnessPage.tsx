/** How the strategies do where car, sensors and actuators are not what they believe: a study put together, followed, read. */

import { Text } from "@mantine/core";
import { useDocumentTitle } from "@mantine/hooks";
import { useQuery } from "@tanstack/react-query";
import { isNotFound, isTransient } from "../api/problem";
import { usePageScenario } from "../origin/origin";
import { ScenarioChoice } from "../origin/ScenarioChoice";
import { schemaQuery, strategiesQuery } from "../state/queries";
import { defaultsQuery } from "./defaults";
import { EarlierStudies } from "./EarlierStudies";
import { StudyForm } from "./StudyForm";
import ui from "../ui/ui.module.css";
import { Loading } from "../ui/Loading";
import { CouldNotLoad } from "../shell/Blank";

export function RobustnessPage() {
  const source = usePageScenario();
  const defaults = useQuery(defaultsQuery);
  const strategies = useQuery(strategiesQuery);
  const form = useQuery(schemaQuery);
  useDocumentTitle("Robustness · Ridelab");
  const fault = [defaults.error, strategies.error, form.error].find((error) => error !== null && !isTransient(error));
  const failure = source.error !== null && !isNotFound(source.error) && !isTransient(source.error) ? source.error : fault;
  return (
      <main className={ui.main}>
        <h1 className={ui.title}>Robustness</h1>
        <Text className={ui.lead ?? ""}>
          The controllers assume one car, exact sensors and ideal actuators. Here every strategy drives the same random cars, whose
          sensors and actuators differ a little from that. How much of each lead is left? With the paper’s weights LV keeps its lead
          over LQR on the bump and loses it on the rough road; with the preset Robust LV it keeps both, as long as its own state is
          measured exactly.
        </Text>
        {failure ? (
          <CouldNotLoad message={failure.message} />
        ) : defaults.data && strategies.data && form.data ? (
          <>
            <StudyForm
              defaults={defaults.data}
              strategies={strategies.data}
              form={form.data}
              scenario={source.scenario}
              head={<ScenarioChoice source={source} form={form.data} />}
            />
            <EarlierStudies strategies={strategies.data} />
          </>
        ) : (
          <Loading label="Loading the form" heights={[28, 96, 440, 320]} />
        )}
      </main>
  );
}
