import { useDocumentTitle, useHotkeys } from "@mantine/hooks";
import { useQuery } from "@tanstack/react-query";
import { lazy, Suspense, useEffect, useMemo } from "react";
import { isTransient } from "./api/problem";
import { useCompared } from "./compare/useCompared";
import { standardScenario } from "./editor/diff";
import { CouldNotLoad } from "./shell/Blank";
import { EditorPane } from "./shell/EditorPane";
import { LabTools } from "./shell/LabTools";
import { Notices } from "./shell/Notices";
import { InShell } from "./shell/places";
import { PrintedTitle } from "./shell/PrintedTitle";
import { Results } from "./shell/Results";
import classes from "./shell/shell.module.css";
import { StatusLine } from "./shell/StatusLine";
import { Toolbar } from "./shell/Toolbar";
import { SharedBanner } from "./share/SharedBanner";
import { DeskProvider, useDesk, useLab, useScenario, useView } from "./state/context";
import { catalogueQuery, figuresQuery, presetsQuery, schemaQuery, strategiesQuery } from "./state/queries";
import { makeScene } from "./state/scene";
import { useSelect } from "./state/store";
import { pageTitle } from "./title";

const SharedSweep = lazy(() => import("./batch/BatchPage").then((module) => ({ default: module.SharedSweep })));

/** The lab, or the sweep that a link shows in its place. */
export function LabPage() {
  const desk = useDesk();
  const form = useQuery(schemaQuery).data;
  const standard = useMemo(() => (form ? standardScenario(form) : {}), [form]);
  const value = useMemo(() => ({ ...desk, standard }), [desk, standard]);
  const shared = useSelect(desk.lab, (state) => state.shared);
  return (
    <DeskProvider value={value}>
      {shared?.batch ? (
        <Suspense>
          <SharedSweep key={shared.slug} link={shared} id={shared.batch.id} />
        </Suspense>
      ) : (
        <Desk />
      )}
    </DeskProvider>
  );
}

/** Signals the moving car needs besides those in the figures. */
const CAR_SIGNALS = ["rear_road"];

function Desk() {
  const { lab } = useDesk();
  const schema = useQuery(schemaQuery);
  const presets = useQuery(presetsQuery);
  const strategies = useQuery(strategiesQuery);
  const catalogue = useQuery(catalogueQuery);
  const figures = useQuery(figuresQuery);
  const shown = useLab((state) => state.shown);
  const selected = useLab((state) => state.strategies);
  const view = useView();
  const compared = useCompared();

  useDocumentTitle(pageTitle(useScenario()));
  useHotkeys([
    ["mod+Z", lab.undo],
    ["mod+shift+Z", lab.redo],
    ["mod+Y", lab.redo],
  ]);
  useEffect(() => {
    if (!schema.data || !figures.data) return;
    const drawn = Object.values(figures.data).flatMap(({ data }) => data.map(({ meta }) => meta.signal));
    lab.configure(schema.data, [...new Set([...drawn, ...CAR_SIGNALS])]);
  }, [lab, schema.data, figures.data]);

  const scene = useMemo(
    () => (shown && strategies.data ? makeScene(shown, strategies.data, selected, view, compared) : null),
    [shown, strategies.data, selected, view, compared],
  );
  const failedQuery = [schema, presets, strategies, catalogue, figures].find(({ error }) => error !== null && !isTransient(error));

  return (
    <>
      <InShell place="tools">
        <LabTools presets={presets.data ?? []} />
      </InShell>
      <PrintedTitle />
      <div className={classes.body}>
        <EditorPane form={schema.data} />
        <main className={classes.main}>
          <h1 className={classes.purpose}>
            What-if laboratory for active suspension. <span>LV control: longitudinal (fuzzy speed plan) and vertical (model predictive suspension).</span>
          </h1>
          <SharedBanner strategies={strategies.data ?? []} catalogue={catalogue.data} figures={figures.data} />
          <Toolbar strategies={strategies.data ?? []} scene={scene} />
          <StatusLine place="page" />
          {failedQuery?.error ? (
            <CouldNotLoad message={failedQuery.error.message} />
          ) : (
            <Results strategies={strategies.data ?? []} catalogue={catalogue.data} figures={figures.data} scene={scene} />
          )}
        </main>
      </div>
      <InShell place="notices">
        <Notices strategies={strategies.data ?? []} />
      </InShell>
    </>
  );
}
