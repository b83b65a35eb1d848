import { Box, Skeleton, Stack } from "@mantine/core";
import { lazy } from "react";
import { useDocumentTitle } from "@mantine/hooks";
import { LabMain } from "./LabMain";
import { DropFiles, EditorPane, LabActions, LabTools } from "./afterCurves";
import { Notices } from "./Notices";
import { ShellSlot } from "../../ui/Page";
import classes from "../../ui/shell.module.css";
import { useLab, useLabContext } from "../../lab/context";
import { useSavedLaws, useWithGone } from "../../lab/laws";
import { useLabStrategies } from "../../lab/recordings";
import { useSchemeColours, useStrategies } from "../../server/useCatalogues";
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

function LabContent() {
  const catalogue = useStrategies();
  useSavedLaws(catalogue);
  const strategies = useWithGone(useLabStrategies());
  const coloured = useSchemeColours(strategies);
  return (
    <>
      <ShellSlot name="tools">
        <LazyPart>
          <LabTools />
          <LabActions />
          <DropFiles />
        </LazyPart>
      </ShellSlot>
      <PrintedTitle />
      <div className={classes.body}>
        <LazyPart fallback={<EditorLoading />}>
          <EditorPane />
        </LazyPart>
        <LabMain strategies={coloured} />
      </div>
      <ShellSlot name="notices">
        <Notices strategies={catalogue} />
      </ShellSlot>
    </>
  );
}

function EditorLoading() {
  return (
    <Box component="aside" visibleFrom="sm" className={classes.aside} data-unprinted aria-label="Scenario" aria-busy>
      <Stack gap="0.9rem" p="1.2rem 1rem">
        {Array.from({ length: 9 }, (_, index) => (
          <Skeleton key={index} height={index % 4 === 0 ? 18 : 44} width={index % 4 === 0 ? "45%" : "100%"} />
        ))}
      </Stack>
    </Box>
  );
}

/** The tab's title; on paper also where this comes from. */
function PrintedTitle() {
  const source = useLab(
    ({ shown }) =>
      shown && `core ${shown.coreVersion}${shown.runId === null ? ", a live preview" : `, run ${shown.runId}`}`,
  );
  // Not of each step of a slider: the browser itself shows it.
  const { paperScenario } = useLabContext();
  const title = useLab(({ history }) => pageTitle(history?.present ?? paperScenario));
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
