/** What the lab puts into the header: library, undo and redo, what the last answer cost, sweep, share and export; and its actions. */

import { useAction, useActionButton, usePaletteEntries, type PaletteEntry } from "../../lab/actions";
import { Icon } from "../../ui/icons";
import { ExportMenu } from "../../features/export/ExportMenu";
import { LibraryButton } from "../../features/library/LibraryButton";
import { ShareRun } from "../../features/share/ShareRun";
import { SweepButton } from "../../features/sweep/SweepButton";
import { endOffer } from "../../features/tour/offered";
import { IconButton } from "../../ui/IconButton";
import { LazyPart } from "../../ui/LazyPart";
import classes from "../../ui/shell.module.css";
import { StatusLine } from "./StatusLine";
import { useLabContext, useLab } from "../../lab/context";
import { hasInvalidInput } from "../../lab/labState";
import { revealed } from "../../lab/reveal";
import { sweepFields } from "../../scenario/fields";
import { optionTitle } from "../../scenario/schema";
import { useLabStrategies } from "../../lab/recordings";
import { useForm, usePresets } from "../../server/useCatalogues";
import { useSelected } from "./StrategyChoice";
import { lazy, useState } from "react";

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
    ...sweepFields(form).map(({ title, section, leaf }): PaletteEntry => ({
      group: "Fields",
      label: title,
      description: `${section}${leaf.kind === "choice" ? `: ${leaf.options.map(optionTitle).join(", ").toLowerCase()}` : ""}`,
      run: () => revealed.set(leaf.pointer),
    })),
  ]);
  const [touring, setTouring] = useState(false);
  useAction("tour", () => {
    endOffer();
    setTouring(true);
  });
  return (
    touring && (
      <LazyPart onClose={() => setTouring(false)}>
        <Tour onEnd={() => setTouring(false)} />
      </LazyPart>
    )
  );
}
