import { useQuery } from "@tanstack/react-query";
import { lazy, useEffect, useMemo } from "react";
import { isTransient } from "./api/problem";
import { standardScenario } from "./editor/diff";
import { DropFiles } from "./library/DropFiles";
import { EditorPane } from "./shell/EditorPane";
import { LabMain } from "./shell/LabMain";
import { LabCommands } from "./shell/LabCommands";
import { LabTools } from "./shell/LabTools";
import { Notices } from "./shell/Notices";
import { ShellSlot } from "./shell/slots";
import { PrintedTitle } from "./shell/PrintedTitle";
import classes from "./shell/shell.module.css";
import { LabContextProvider, useLabContext } from "./state/context";
import { catalogueQuery, figuresQuery, presetsQuery, schemaQuery, strategiesQuery } from "./state/queries";
import { useSelect } from "./state/store";
import { useSchemeColours } from "./state/useSchemeColours";
import { LazyPart } from "./ui/LazyPart";

const SharedSweep = lazy(() => import("./batch/BatchPage").then((module) => ({ default: module.SharedSweep })));

/** The lab, or the sweep that a link shows in its place. */
export function LabPage() {
  const context = useLabContext();
  const form = useQuery(schemaQuery).data;
  const standard = useMemo(() => (form ? standardScenario(form) : {}), [form]);
  const value = useMemo(() => ({ ...context, standard }), [context, standard]);
  const shared = useSelect(context.lab, (state) => state.shared);
  return (
    <LabContextProvider value={value}>
      {shared?.batch ? (
        <LazyPart>
          <SharedSweep key={shared.slug} link={shared} id={shared.batch.id} />
        </LazyPart>
      ) : (
        <LabContent />
      )}
    </LabContextProvider>
  );
}

/** Signals the moving car needs besides those in the figures. */
const CAR_SIGNALS = ["rear_road"];
const NONE: readonly never[] = [];

function LabContent() {
  const { lab } = useLabContext();
  const schema = useQuery(schemaQuery);
  const presets = useQuery(presetsQuery);
  const strategies = useQuery(strategiesQuery);
  const coloured = useSchemeColours(strategies.data) ?? NONE;
  const catalogue = useQuery(catalogueQuery);
  const figures = useQuery(figuresQuery);
  useEffect(() => {
    if (!schema.data || !figures.data) return;
    const drawn = Object.values(figures.data).flatMap(({ data }) => data.map(({ meta }) => meta.signal));
    lab.configure(schema.data, [...new Set([...drawn, ...CAR_SIGNALS])]);
  }, [lab, schema.data, figures.data]);

  const failedQuery = [schema, presets, strategies, catalogue, figures].find(({ error }) => error !== null && !isTransient(error));

  return (
    <>
      <ShellSlot name="tools">
        <LabTools presets={presets.data ?? NONE} />
      </ShellSlot>
      <LabCommands form={schema.data} presets={presets.data ?? NONE} strategies={strategies.data ?? NONE} />
      <PrintedTitle />
      <div className={classes.body}>
        <EditorPane form={schema.data} />
        <LabMain strategies={coloured} catalogue={catalogue.data} figures={figures.data} fault={failedQuery?.error?.message} />
      </div>
      <DropFiles />
      <ShellSlot name="notices">
        <Notices strategies={strategies.data ?? NONE} />
      </ShellSlot>
    </>
  );
}
