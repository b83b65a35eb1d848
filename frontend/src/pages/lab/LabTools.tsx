/** What the lab puts into the header: library, undo and redo, what the last answer cost, sweep, share and export; and its actions. */

import { useAction, useActionButton, usePaletteEntries, type PaletteEntry, revealed } from "../../lab/actions";
import { Icon } from "../../ui/icons";
import { ExportMenu } from "../../features/export/ExportMenu";
import { SweepButton } from "../../features/sweep/SweepButton";
import { endOffer } from "../../features/tour/offered";
import { IconButton, compact } from "../../ui/IconButton";
import { LazyPart } from "../../ui/LazyPart";
import classes from "../../ui/shell.module.css";
import { StatusLine } from "./StatusLine";
import { useLabContext, useLab, useReadOnly } from "../../lab/context";
import { hasErrors } from "../../lab/problems";
import { hasInvalidInput, type LabState } from "../../lab/labState";
import { sweepFields } from "../../scenario/fields";
import { optionTitle } from "../../scenario/schema";
import { useLabStrategies } from "../../lab/recordings";
import { useForm, usePresets } from "../../server/useCatalogues";
import { lazy, useState } from "react";
import { useSelected } from "./Toolbar";
import { ask } from "../../api/http";
import { useCompared } from "../../features/compare/useCompared";
import { cursor } from "../../lab/cursor";
import { makeResultView } from "../../lab/resultView";
import { viewToShare } from "../../lab/sharing";
import { ShareLink } from "../../features/share/ShareLink";
import { Button } from "@mantine/core";
import { vehiclesQuery } from "../../server/queries";
import { useQuery } from "@tanstack/react-query";
import { useSelector } from "@tanstack/react-store";
import { useOpenItem } from "../../features/library/open";
import { dialog, kindWord, ownLibrary } from "../../scenario/library";

const DataSheetDialog = lazy(() =>
  import("../../features/editor/DataSheetDialog").then((module) => ({ default: module.DataSheetDialog })),
);
const Tour = lazy(() => import("../../features/tour/Tour").then((module) => ({ default: module.Tour })));

export function LabTools() {
  return (
    <>
      <LibraryButton />
      <IconButton {...useActionButton("undo")}>
        <Icon name="ArrowBackUp" size={18} stroke={1.7} />
      </IconButton>
      <IconButton {...useActionButton("redo")}>
        <Icon name="ArrowForwardUp" size={18} stroke={1.7} />
      </IconButton>
      <StatusLine position="header" />
      <span className={classes.grow} />
      <SweepButton />
      <ShareRun />
      <ExportMenu />
    </>
  );
}

/** What can be done to the lab's scenario, and what of it is found by name. */
export function LabActions() {
  const { lab } = useLabContext();
  const [form, presets, strategies] = [useForm(), usePresets(), useLabStrategies()];
  const { selected, toggle } = useSelected(strategies);
  const canEdit = useLab((state) => state.shared === null);
  const canUndo = useLab((state) => hasInvalidInput(state) || (state.history?.past.length ?? 0) > 0);
  const canRedo = useLab((state) => (state.history?.future.length ?? 0) > 0);
  useAction("undo", canEdit && canUndo ? lab.undo : null);
  useAction("redo", canEdit && canRedo ? lab.redo : null);
  useAction("paper", canEdit ? lab.openPaper : null);
  usePaletteEntries([
    ...(canEdit ? presets : []).map(({ label, description, scenario }): PaletteEntry => ({
      group: "Presets",
      label,
      description,
      run: () => lab.commit(scenario),
    })),
    ...strategies.map(({ id, label, description }): PaletteEntry => ({
      group: "Strategies",
      label: `${selected.includes(id) ? "Hide" : "Show"} ${label}`,
      description,
      run: () => toggle(id),
    })),
    ...sweepFields(form).map(({ name, title, section, leaf }): PaletteEntry => ({
      group: "Fields",
      label: title,
      searchWords: [name, ...(leaf.searchWords ?? [])],
      description: `${section}${leaf.kind === "choice" ? `: ${leaf.options.map(optionTitle).join(", ").toLowerCase()}` : ""}`,
      run: () => revealed.set(leaf.pointer),
    })),
  ]);
  const [touring, setTouring] = useState(false);
  useAction("tour", () => {
    endOffer();
    setTouring(true);
  });
  const [hasSheet, setHasSheet] = useState(false);
  useAction("dataSheet", canEdit ? () => setHasSheet(true) : null);
  const closeSheet = () => setHasSheet(false);
  return (
    <>
      {touring && (
        <LazyPart onClose={() => setTouring(false)}>
          <Tour onEnd={() => setTouring(false)} />
        </LazyPart>
      )}
      {hasSheet && (
        <LazyPart onClose={closeSheet}>
          <DataSheetDialog onClose={closeSheet} />
        </LazyPart>
      )}
    </>
  );
}

const OPENS =
  "It opens this scenario with these results, strategies, comparison, zoom, cursor, instant and pins, for anyone who has the link. It is read-only.";

function obstacleOf({ failure, shown, stale, serverErrors }: LabState): string | null {
  if (failure?.kind === "unreachable") return "The server does not answer";
  if (failure?.kind === "notFound") return "There is no result here";
  if (failure || hasErrors(serverErrors)) return "These values could not be run";
  if (shown?.source !== "exact" || stale) return "There is no result of these values yet";
  return null;
}

/** Shares what the dashboard shows. */
function ShareRun() {
  const { lab, labAddress } = useLabContext();
  const obstacle = useLab(obstacleOf);
  const catalogue = useLabStrategies();
  const compared = useCompared();
  const make = () => {
    const { shown, strategies } = lab.get();
    if (!shown?.runId) return Promise.reject(new Error("there is no result"));
    const { view } = labAddress.get();
    const resultView = makeResultView(shown, catalogue, strategies, view, compared);
    return ask("post", "/links", {
      body: {
        run_id: shown.runId,
        view: viewToShare(resultView, cursor.get(resultView.axis), view.instant),
        requirements: view.requirements,
      },
    });
  };
  return <ShareLink make={make} obstacle={obstacle} opens={OPENS} />;
}

/** Opens the library; what is in it is found by name. */
const LibraryDialog = lazy(() =>
  import("../../features/library/LibraryDialog").then((module) => ({ default: module.LibraryDialog })),
);

const close = () => dialog.set(null);

function LibraryButton() {
  const readOnly = useReadOnly();
  const saving = useSelector(dialog);
  const items = useSelector(ownLibrary);
  const open = useOpenItem();
  const canEdit = !readOnly;
  useAction("library", canEdit ? () => dialog.set("scenario") : null);
  useAction("saveVehicle", canEdit ? () => dialog.set("vehicle") : null);
  const { data: vehicles = [] } = useQuery(vehiclesQuery);
  const found = [
    ...vehicles.map(({ label, vehicle }) => ({
      label,
      description: "Vehicle",
      kind: "vehicle" as const,
      value: vehicle,
    })),
    ...items.map((item) => ({ label: item.name, description: `Own ${kindWord(item.kind)}`, ...item })),
  ].map(({ label, description, ...item }) => ({
    group: "Library" as const,
    label,
    description,
    run: () => open(item),
  }));
  usePaletteEntries(canEdit ? found : []);
  const { label, ...button } = useActionButton("library");
  return (
    <>
      <Button
        aria-label={label}
        leftSection={<Icon name="Template" size={16} stroke={1.7} />}
        classNames={compact}
        {...button}
      >
        {label}
      </Button>
      {saving && canEdit && (
        <LazyPart onClose={close}>
          <LibraryDialog saving={saving} onClose={close} />
        </LazyPart>
      )}
    </>
  );
}
