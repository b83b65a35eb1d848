/** The ECU: the controller as a C program apart from the car, what it loses by that, and whether it fits a real part. */

import { Skeleton, Text } from "@mantine/core";
import { useMemo, useState, useEffect, useRef } from "react";
import { ApiProblem, isTransient } from "../../api/problem";
import type { JsonValue, Scenario } from "../../api/types";
import { usePageScenario, type PageScenario } from "../../features/scenarioSource/scenarioSource";
import { ScenarioChoice } from "../../features/scenarioSource/ScenarioChoice";
import { errorsByField } from "../../scenario/fields";
import { Page, Loading } from "../../ui/Page";
import { useForm, useSchemeColours, useStrategies } from "../../server/useCatalogues";
import { BuildReport } from "./BuildReport";
import { EcuFigures, EcuTable } from "./EcuResults";
import ui from "../../ui/ui.module.css";
import { Problems } from "../../ui/Messages";
import { Card, Columns } from "../../ui/Card";
import { ControllerFile } from "../../features/export/FileMenu";
import { ShareAddress } from "../../features/share/ShareLink";
import { ChoiceFieldRow, type LeafState } from "../../features/editor/FieldFrame";
import { NumberFieldRow } from "../../features/editor/NumberFieldRow";
import { getAt, sameValue, setAt, type Pointer } from "../../scenario/path";
import { fieldsOf, findMember, type ChoiceField, type NumberField } from "../../scenario/schema";
import type { InvalidInput } from "../../lab/labState";
import { keepPreviousData, queryOptions, useMutation, useQuery, useQueryClient } from "@tanstack/react-query";
import { api } from "../../api/client";
import { split } from "../../lab/result";
import { runKey } from "../../server/queries";

const NO_ERRORS = { fields: {}, general: [] };

export function EcuPage() {
  const source = usePageScenario();
  const { scenario, run, stale, error, change, choose } = useEcuRun(source);
  const [form, strategies] = [useForm(), useStrategies()];

  const refused = useMemo(() => {
    if (!error || isTransient(error)) return NO_ERRORS;
    return error instanceof ApiProblem
      ? errorsByField(form, error.errors, error.message)
      : { fields: {}, general: [error.message] };
  }, [error, form]);
  const coloured = useSchemeColours(strategies);
  const shown = useMemo(() => STRATEGIES.flatMap((id) => coloured.find((each) => each.id === id) ?? []), [coloured]);
  const { summaries, failed } = useMemo(() => split(run?.strategies ?? {}), [run]);
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
      lead={lead}
      tools={
        <>
          <ShareAddress what="run" ready={run !== undefined && !stale} path={`/ecu?run=${run?.id ?? ""}`} />
          <ControllerFile scenario={source.scenario} />
        </>
      }
    >
      <Card className={`${ui.part}`} aria-label="Scenario and loop">
        <ScenarioChoice source={{ ...source, choose }} />
        {scenario ? (
          <EcuForm scenario={scenario} errors={refused.fields} onChange={change} />
        ) : (
          <Skeleton height={58} />
        )}
        <Problems messages={[...refused.general, ...elsewhere(refused.fields)]} />
      </Card>
      <Problems
        messages={failed.map(({ strategy, message }) => {
          const label = shown.find(({ id }) => id === strategy)?.label ?? strategy;
          return `${label} could not be driven: ${message}`;
        })}
      />
      {run ? (
        <>
          <EcuTable {...{ summaries, stale }} strategies={shown} />
          <EcuFigures {...{ run, stale }} strategies={shown} />
        </>
      ) : (
        refused === NO_ERRORS && (
          <>
            <Text c="dimmed">The program is driven over the road.</Text>
            <Loading label="Driving" heights={[420]} />
          </>
        )
      )}
      {source.scenario && <BuildReport scenario={source.scenario} />}
    </Page>
  );
}

/** Errors at fields this page has no entry for. */
const elsewhere = (fields: Readonly<Record<string, string>>) =>
  Object.entries(fields).flatMap(([pointer, message]) =>
    pointer.startsWith("/hil/") ? [] : [`The scenario’s ${pointer.slice(1).replace(/\//g, ".")}: ${message}`],
  );

interface Props {
  readonly scenario: Scenario;
  /** The server's, by field. */
  readonly errors: Readonly<Record<Pointer, string>>;
  readonly onChange: (scenario: Scenario) => void;
}

function EcuForm(props: Props) {
  const group = findMember(useForm(), "/hil");
  if (!group) return null;
  return (
    <Columns least="22rem" gap="0.3rem 2rem" role="group" aria-label="Between the ECU and the car">
      {fieldsOf(group).map(
        (field) =>
          (field.kind === "number" || field.kind === "choice") && (
            <Setting key={field.pointer} field={field} {...props} />
          ),
      )}
    </Columns>
  );
}

interface SettingProps extends Props {
  readonly field: NumberField | ChoiceField;
}

function Setting({ field, scenario, errors, onChange }: SettingProps) {
  const [rejected, setRejected] = useState<InvalidInput | undefined>();
  const value = getAt(scenario, field.pointer);
  const commit = (next: JsonValue) => {
    setRejected(undefined);
    if (!sameValue(value, next)) onChange(setAt(scenario, field.pointer, next));
  };
  const leaf: LeafState = {
    value,
    readOnly: false,
    changed: !sameValue(value, field.paperValue),
    rejected,
    error: rejected?.message ?? errors[field.pointer],
    drag: commit,
    release: () => undefined,
    commit,
    reject: setRejected,
    clearInvalid: () => setRejected(undefined),
  };
  return field.kind === "number" ? (
    <NumberFieldRow {...{ field, leaf }} withSlider={false} />
  ) : (
    <ChoiceFieldRow {...{ field, leaf }} />
  );
}

const STRATEGIES = ["lv", "lv_hil", "lqr"] as const;

const ecuRunQuery = (scenario: Scenario | undefined) =>
  queryOptions({
    queryKey: ["ecu run", scenario ?? null],
    queryFn: ({ signal }) => api.createRun(scenario ?? {}, STRATEGIES, signal),
    enabled: scenario !== undefined,
    staleTime: Infinity,
  });

function useEcuRun({ scenario: stored, choose }: PageScenario) {
  const queries = useQueryClient();
  const newest = useRef<AbortController>(null);
  const drop = () => newest.current?.abort();
  // After the page is left, an answer chooses nothing.
  useEffect(() => drop, []);
  const changed = useMutation({
    mutationFn: (scenario: Scenario) => {
      drop();
      newest.current = new AbortController();
      return api.createRun(scenario, STRATEGIES, newest.current.signal);
    },
    onSuccess: (run) => {
      queries.setQueryData(runKey(run.id), run);
      queries.setQueryData(ecuRunQuery(run.scenario).queryKey, run);
      choose({ run: run.id });
    },
  });
  // Until the server has taken an edit, the form shows it over the stored one.
  const edited = changed.isPending || changed.isError ? changed.variables : undefined;
  const shown = useQuery({ ...ecuRunQuery(stored), placeholderData: keepPreviousData });
  return {
    scenario: edited ?? stored,
    run: shown.data,
    /** What is shown is older than what was asked for. */
    stale: shown.isPlaceholderData || changed.isPending,
    error: changed.error ?? shown.error,
    /** Runs the changed scenario; the page's address follows. */
    change: (scenario: Scenario) => changed.mutate(scenario),
    choose: (origin: PageScenario["origin"]) => {
      drop();
      changed.reset();
      choose(origin);
    },
  };
}
