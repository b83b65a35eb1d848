import { useQuery } from "@tanstack/react-query";
import { lazy, useEffect } from "react";
import { useDocumentTitle } from "@mantine/hooks";
import { isTransient } from "../../api/problem";
import { DropFiles } from "../../features/library/OpenFiles";
import { EditorPane } from "./EditorPane";
import { LabMain } from "./LabMain";
import { LabActions } from "./LabActions";
import { LabTools } from "./LabTools";
import { Notices } from "./Notices";
import { ShellSlot } from "../../ui/Page";
import classes from "../../ui/shell.module.css";
import { useLabContext, useFromScenario, useLab } from "../../lab/context";
import { catalogueQuery, figuresQuery, presetsQuery, schemaQuery, strategiesQuery } from "../../server/queries";
import { useSchemeColours } from "../../server/useCatalogues";
import { LazyPart } from "../../ui/LazyPart";
import type { Scenario } from "../../api/types";
import { getAt } from "../../scenario/path";

const SharedSweep = lazy(() => import("../sweep/SweepPage").then((module) => ({ default: module.SharedSweep })));

/** The lab, or the sweep that a link shows in its place. */
export function LabPage() {
  const shared = useLab((state) => state.shared);
  return shared?.batch ? (
    <LazyPart>
      <SharedSweep key={shared.slug} link={shared} id={shared.batch.id} />
    </LazyPart>
  ) : (
    <LabContent />
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
      <LabActions form={schema.data} presets={presets.data ?? NONE} strategies={strategies.data ?? NONE} />
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

/** The tab's title; on paper also where this comes from. */
function PrintedTitle() {
  const source = useLab(
    ({ shown }) =>
      shown && `core ${shown.coreVersion}${shown.runId === null ? ", a live preview" : `, run ${shown.runId}`}`,
  );
  const title = useFromScenario(pageTitle);
  useDocumentTitle(title);
  if (source === null) return null;
  return (
    <p className={classes.printed}>
      {title} {source}
    </p>
  );
}

/** The browser tab's title: what this scenario is about, in a few words. */
function pageTitle(scenario: Scenario): string {
  const height = getAt(scenario, "/road/bump/height");
  const from = getAt(scenario, "/speed/initial_speed_kmh");
  const to = getAt(scenario, "/speed/target_speed_kmh");
  if (typeof height !== "number" || typeof from !== "number" || typeof to !== "number") return "Ridelab";
  const count = getAt(scenario, "/road/bump/count");
  const several = typeof count === "number" && count > 1 ? `${count} × ` : "";
  const kind = getAt(scenario, "/road/bump/shape") === "kerb" ? "kerb" : height > 0 ? "bump" : "pothole";
  const obstacle = height === 0 ? "no bump" : `${several}${Math.abs(height * 1000).toFixed(0)} mm ${kind}`;
  return `${obstacle}, ${from} → ${to} km/h · Ridelab`;
}
