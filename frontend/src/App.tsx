import { useDocumentTitle, useHotkeys } from "@mantine/hooks";
import { useQuery } from "@tanstack/react-query";
import { Suspense, useEffect, useMemo } from "react";
import { isTransient } from "./api/problem";
import { LazyBatchPage } from "./batch/lazy";
import { standardScenario } from "./editor/diff";
import { ConnectionBanner } from "./shell/ConnectionBanner";
import { CouldNotLoad } from "./shell/Blank";
import { EditorPane } from "./shell/EditorPane";
import { Header } from "./shell/Header";
import { Notices } from "./shell/Notices";
import { PrintedTitle } from "./shell/PrintedTitle";
import { Results } from "./shell/Results";
import classes from "./shell/shell.module.css";
import { StatusLine } from "./shell/StatusLine";
import { Toolbar } from "./shell/Toolbar";
import { SharedBanner } from "./share/SharedBanner";
import { DeskProvider, useDesk, useLab, useScenario, useView } from "./state/context";
import type { Lab } from "./state/labState";
import { catalogueQuery, figuresQuery, presetsQuery, schemaQuery, strategiesQuery } from "./state/queries";
import type { Router } from "./state/router";
import { makeScene } from "./state/scene";
import { useSelect } from "./state/store";
import { pageTitle } from "./title";

export function App({ lab, router }: { readonly lab: Lab; readonly router: Router }) {
  const form = useQuery(schemaQuery).data;
  const standard = useMemo(() => (form ? standardScenario(form) : {}), [form]);
  const shared = useSelect(lab, (state) => state.shared);
  if (shared?.batch) {
    return (
      <Suspense>
        <LazyBatchPage key={shared.slug} id={shared.batch.id} link={shared} />
      </Suspense>
    );
  }
  return (
    <DeskProvider value={{ lab, router, standard }}>
      <Desk />
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
    () => (shown && strategies.data ? makeScene(shown, strategies.data, selected, view) : null),
    [shown, strategies.data, selected, view],
  );
  const failedQuery = [schema, presets, strategies, catalogue, figures].find(({ error }) => error !== null && !isTransient(error));

  return (
    <div className={classes.shell}>
      <Header presets={presets.data ?? []} />
      <PrintedTitle />
      <div className={classes.body}>
        <EditorPane form={schema.data} />
        <main className={classes.main}>
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
      <div className={classes.notices}>
        <Notices strategies={strategies.data ?? []} />
        <ConnectionBanner onBack={lab.resume} />
      </div>
    </div>
  );
}
