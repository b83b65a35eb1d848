/** The ECU: the controller as a C program apart from the car, what it loses by that, and whether it fits a real part. */

import { Alert, Skeleton, Text } from "@mantine/core";
import { useMemo } from "react";
import { ApiProblem, isTransient } from "../../api/problem";
import type { Summary } from "../../api/types";
import { usePageScenario } from "../../features/scenarioSource/scenarioSource";
import { ScenarioChoice } from "../../features/scenarioSource/ScenarioChoice";
import { errorsByField } from "../../scenario/errors";
import { Page } from "../../ui/Page";
import { useCatalogue, useFigures, useForm, useSchemeColours, useStrategies } from "../../server/useCatalogues";
import { BuildReport } from "./BuildReport";
import { EcuFigures } from "./EcuFigures";
import { EcuTable } from "./EcuTable";
import { EcuForm } from "./EcuForm";
import { RealTime } from "./RealTime";
import { STRATEGIES, useEcuRun } from "./useEcuRun";
import ui from "../../ui/ui.module.css";
import { Problems } from "../../ui/Fault";
import { Card } from "../../ui/Card";
import { Loading } from "../../ui/Blank";
import { ControllerFile } from "../../features/export/FileMenu";
import { ShareAddress } from "../../features/share/ShareAddress";

const NO_ERRORS = { fields: {}, general: [] };

export function EcuPage() {
  const source = usePageScenario();
  const { scenario, run, stale, error, change, choose } = useEcuRun(source);
  const [form, strategies, catalogue, figures] = [useForm(), useStrategies(), useCatalogue(), useFigures()];

  const refused = useMemo(() => {
    if (!error || isTransient(error)) return NO_ERRORS;
    return error instanceof ApiProblem
      ? errorsByField(form, error.errors, error.message)
      : { fields: {}, general: [error.message] };
  }, [error, form]);
  const coloured = useSchemeColours(strategies);
  const shown = useMemo(() => STRATEGIES.flatMap((id) => coloured.find((each) => each.id === id) ?? []), [coloured]);
  const { summaries, failures } = useMemo(() => split(run?.strategies ?? {}), [run]);
  const colour = shown.find(({ id }) => id === "lv_hil")?.colour ?? "currentColor";
  const lead = (
    <>
      LV control’s MPC, written out as C for this scenario (float32, a fixed number of iterations), drives the simulated
      car: sensors and commands through converters, every command a step late.{" "}
      <strong>This is software in the loop with the ECU’s code, not a bench</strong>: no ECU, wire or actuator takes
      part.
    </>
  );

  return (
    <Page
      title="ECU"
      heading="The controller as an ECU’s program"
      what="page"
      lead={lead}
      tools={
        <>
          <ShareAddress what="run" ready={run !== undefined && !stale} path={`/ecu?run=${run?.id ?? ""}`} />
          <ControllerFile scenario={source.scenario} />
        </>
      }
      faults={[]}
    >
      <Card className={`${ui.part}`} aria-label="Scenario and loop">
        <ScenarioChoice source={{ ...source, choose }} form={form} />
        {scenario ? (
          <EcuForm form={form} scenario={scenario} errors={refused.fields} onChange={change} />
        ) : (
          <Skeleton height={58} />
        )}
        <Problems messages={[...refused.general, ...elsewhere(refused.fields)]} />
      </Card>
      {failures.map(({ id, reason }) => (
        <Alert key={id} color="red" variant="light" p="xs" role="alert">
          {shown.find((each) => each.id === id)?.label ?? id} could not be driven: {reason}
        </Alert>
      ))}
      {run ? (
        <>
          <EcuTable {...{ summaries, stale }} strategies={shown} catalogue={catalogue} figures={figures} />
          <EcuFigures {...{ run, stale }} strategies={shown} catalogue={catalogue} figures={figures} />
        </>
      ) : (
        refused === NO_ERRORS && <EcuLoading />
      )}
      {source.scenario && (
        <>
          <BuildReport scenario={source.scenario} catalogue={catalogue} />
          <RealTime
            scenario={source.scenario}
            catalogue={catalogue}
            seconds={summaries.lv_hil?.travel_time ?? undefined}
            colour={colour}
          />
        </>
      )}
    </Page>
  );
}

/** Errors at fields this page has no entry for. */
const elsewhere = (fields: Readonly<Record<string, string>>) =>
  Object.entries(fields).flatMap(([pointer, message]) =>
    pointer.startsWith("/hil/") ? [] : [`The scenario’s ${pointer.slice(1).replace(/\//g, ".")}: ${message}`],
  );

function split(all: NonNullable<ReturnType<typeof useEcuRun>["run"]>["strategies"]) {
  const summaries: Record<string, Summary> = {};
  const failures: { readonly id: string; readonly reason: string }[] = [];
  for (const [id, answer] of Object.entries(all)) {
    if (answer.status === "ok") summaries[id] = answer;
    else failures.push({ id, reason: answer.reason });
  }
  return { summaries, failures };
}

function EcuLoading() {
  return (
    <>
      <Text c="dimmed">The program is driven over the road.</Text>
      <Loading label="Driving" heights={[420]} />
    </>
  );
}
