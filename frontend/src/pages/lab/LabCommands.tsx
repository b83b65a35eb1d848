/** What the lab can do by name or by key. */

import type { Preset, Strategy } from "../../api/types";
import type { Group } from "../../scenario/schema";
import { useCommands, type Command } from "../../lab/commands";
import { useLabContext, useLab } from "../../lab/context";
import { revealed } from "../../lab/reveal";
import { sweepFields } from "../../scenario/fields";
import { useSelected } from "./StrategyChoice";

interface Props {
  readonly form: Group | undefined;
  readonly presets: readonly Preset[];
  readonly strategies: readonly Strategy[];
}

export function LabCommands({ form, presets, strategies }: Props) {
  const { lab } = useLabContext();
  const { selected, toggle } = useSelected(strategies);
  const isReadOnly = useLab((state) => state.shared !== null);

  const edits: readonly Command[] = [
    { group: "Lab", label: "Undo", keys: "mod+Z", run: lab.undo },
    { group: "Lab", label: "Redo", keys: "mod+shift+Z", run: lab.redo },
    { group: "Lab", label: "Redo", keys: "mod+Y", run: lab.redo },
    { group: "Lab", label: "Open the paper’s scenario", run: lab.openPaper },
    ...presets.map(({ label, description, scenario }): Command => ({
      group: "Presets",
      label,
      description,
      run: () => lab.commit(scenario),
    })),
  ];
  useCommands([
    ...(isReadOnly ? [] : edits),
    ...strategies.map(({ id, label, description }): Command => ({
      group: "Strategies",
      label: `${selected.includes(id) ? "Hide" : "Show"} ${label}`,
      description,
      run: () => toggle(id),
    })),
    ...(form ? sweepFields(form) : []).map(({ title, section, leaf }): Command => ({
      group: "Fields",
      label: title,
      description: section,
      run: () => revealed.set(leaf.pointer),
    })),
  ]);
  return null;
}
