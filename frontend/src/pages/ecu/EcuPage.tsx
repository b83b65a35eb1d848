/** The ECU: the controller as a C program apart from the car, what it loses by that, and whether it fits a real part. */

import { Alert, Skeleton, Text } from "@mantine/core";
import { useMemo, useState, useEffect, useRef } from "react";
import { ApiProblem, isTransient } from "../../api/problem";
import type { Summary, JsonValue, Scenario, Run } from "../../api/types";
import { usePageScenario, type PageScenario } from "../../features/scenarioSource/scenarioSource";
import { ScenarioChoice } from "../../features/scenarioSource/ScenarioChoice";
import { Page, Loading } from "../../ui/Page";
import { useForm, useSchemeColours, useStrategies } from "../../server/useCatalogues";
import { BuildReport } from "./BuildReport";
import { EcuFigures } from "./EcuFigures";
import { EcuTable } from "./EcuTable";
import { RealTime } from "./RealTime";
import ui from "../../ui/ui.module.css";
import { Problems } from "../../ui/Messages";
import { Card, Columns } from "../../ui/Card";
import { ControllerFile } from "../../features/export/FileMenu";
import { ChoiceFieldRow, type LeafState } from "../../features/editor/FieldFrame";
import { NumberFieldRow } from "../../features/editor/NumberFieldRow";
import { getAt, sameValue, setAt, type Pointer } from "../../scenario/path";
import { fieldsOf, findMember, type ChoiceField, type Group, type NumberField } from "../../scenario/schema";
import type { InvalidInput } from "../../lab/labState";
import { keepPreviousData, queryOptions, useMutation, useQuery, useQueryClient } from "@tanstack/react-query";
import { api } from "../../api/client";
import { runKey } from "../../server/queries";
import { errorsByField } from "../../scenario/fields";
import { ShareAddress } from "../../features/share/ShareLink";

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
      lead={lead}
      tools={
        <>
          <ShareAddress what="run" ready={run !== undefined && !stale} path={`/ecu?run=${run?.id ?? ""}`} />
          <ControllerFile scenario={source.scenario} />
        </>
      }
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
          <EcuTable {...{ summaries, stale }} strategies={shown} />
          <EcuFigures {...{ run, stale }} strategies={shown} />
        </>
      ) : (
        refused === NO_ERRORS && <EcuLoading />
      )}
      {source.scenario && (
        <>
          <BuildReport scenario={source.scenario} />
          <RealTime scenario={source.scenario} seconds={summaries.lv_hil?.travel_time ?? undefined} colour={colour} />
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

interface Props {
  readonly form: Group;
  readonly scenario: Scenario;
  /** The server's, by field. */
  readonly errors: Readonly<Record<Pointer, string>>;
  readonly onChange: (scenario: Scenario) => void;
}

function EcuForm({ form, ...props }: Props) {
  const group = findMember(form, "/hil");
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

function Setting({
  field,
  scenario,
  errors,
  onChange,
}: Omit<Props, "form"> & { readonly field: NumberField | ChoiceField }) {
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

interface EcuRun {
  readonly scenario: Scenario | undefined;
  readonly run: Run | undefined;
  /** What is shown is older than what was asked for. */
  readonly stale: boolean;
  readonly busy: boolean;
  readonly error: Error | null;
  /** Runs the changed scenario; the page's address follows. */
  readonly change: (scenario: Scenario) => void;
  /** Another scenario altogether. */
  readonly choose: PageScenario["choose"];
}

function useEcuRun({ scenario: stored, choose }: PageScenario): EcuRun {
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
    stale: shown.isPlaceholderData || changed.isPending,
    busy: shown.isFetching || changed.isPending,
    error: changed.error ?? shown.error,
    change: (scenario) => changed.mutate(scenario),
    choose: (origin) => {
      drop();
      changed.reset();
      choose(origin);
    },
  };
}
