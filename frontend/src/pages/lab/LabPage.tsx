import { useQuery } from "@tanstack/react-query";
import { lazy, useEffect, useMemo } from "react";
import { isTransient } from "../../api/problem";
import { standardScenario } from "../../scenario/differences";
import { DropFiles } from "../../features/library/DropFiles";
import { EditorPane } from "./EditorPane";
import { LabMain } from "./LabMain";
import { LabCommands } from "./LabCommands";
import { LabTools } from "./LabTools";
import { Notices } from "./Notices";
import { ShellSlot } from "../../ui/slots";
import { PrintedTitle } from "./PrintedTitle";
import classes from "../../ui/shell.module.css";
import { LabContextProvider, useLabContext } from "../../lab/context";
import { catalogueQuery, figuresQuery, presetsQuery, schemaQuery, strategiesQuery } from "../../server/queries";
import { useSelect } from "../../lib/store";
import { useSchemeColours } from "../../server/useSchemeColours";
import { LazyPart } from "../../ui/LazyPart";

const SharedSweep = lazy(() => import("../sweep/SweepPage").then((module) => ({ default: module.SharedSweep })));

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

  const failedQuery = [schema, presets, strategies, catalogue, figures].find(
    ({ error }) => error !== null && !isTransient(error),
  );

  return (
    <>
      <ShellSlot name="tools">
        <LabTools presets={presets.data ?? NONE} />
      </ShellSlot>
      <LabCommands form={schema.data} presets={presets.data ?? NONE} strategies={strategies.data ?? NONE} />
      <PrintedTitle />
      <div className={classes.body}>
        <EditorPane form={schema.data} />
        <LabMain
          strategies={coloured}
          catalogue={catalogue.data}
          figures={figures.data}
          fault={failedQuery?.error?.message}
        />
      </div>
      <DropFiles />
      <ShellSlot name="notices">
        <Notices strategies={strategies.data ?? NONE} />
      </ShellSlot>
    </>
  );
}
