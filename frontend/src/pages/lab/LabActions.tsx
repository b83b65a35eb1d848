/** What can be done to the lab's scenario, and what of it is found by name. */

import type { Preset, Strategy } from "../../api/types";
import { useAction, usePaletteEntries, type PaletteEntry } from "../../lab/actions";
import { useLabContext, useLab } from "../../lab/context";
import { hasInvalidInput } from "../../lab/labState";
import { revealed } from "../../lab/reveal";
import { sweepFields } from "../../scenario/fields";
import { optionTitle, type Group } from "../../scenario/schema";
import { useSelected } from "./StrategyChoice";

interface Props {
  readonly form: Group | undefined;
  readonly presets: readonly Preset[];
  readonly strategies: readonly Strategy[];
}

export function LabActions({ form, presets, strategies }: Props) {
  const { lab } = useLabContext();
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
    ...(form ? sweepFields(form) : []).map(({ title, section, leaf }): PaletteEntry => ({
      group: "Fields",
      label: title,
      description: `${section}${leaf.kind === "choice" ? `: ${leaf.options.map(optionTitle).join(", ").toLowerCase()}` : ""}`,
      run: () => revealed.set(leaf.pointer),
    })),
  ]);
  return null;
}
