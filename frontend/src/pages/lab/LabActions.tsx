/** What can be done to the lab's scenario, and what of it is found by name. */

import { useAction, usePaletteEntries, type PaletteEntry } from "../../lab/actions";
import { useLabContext, useLab } from "../../lab/context";
import { hasInvalidInput } from "../../lab/labState";
import { revealed } from "../../lab/reveal";
import { sweepFields } from "../../scenario/fields";
import { useLabStrategies } from "../../lab/recordings";
import { useFigures, useForm, usePresets } from "../../server/useCatalogues";
import { optionTitle } from "../../scenario/schema";
import { useSelected } from "./StrategyChoice";
import { useEffect } from "react";

/** Signals the moving car needs besides those in the figures. */
const CAR_SIGNALS = ["rear_road"];

export function LabActions() {
  const { lab } = useLabContext();
  const [form, presets, strategies, figures] = [useForm(), usePresets(), useLabStrategies(), useFigures()];
  useEffect(() => {
    const drawn = Object.values(figures).flatMap(({ data }) => data.map(({ meta }) => meta.signal));
    lab.configure(form, [...new Set([...drawn, ...CAR_SIGNALS])]);
  }, [lab, form, figures]);
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
  return null;
}
