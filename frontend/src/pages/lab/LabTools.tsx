/** What the lab puts into the header: library, undo and redo, what the last answer cost, sweep, share and export. */

import { IconArrowBackUp, IconArrowForwardUp } from "../../ui/icons";
import type { Preset } from "../../api/types";
import { useLabContext, useLab } from "../../lab/context";
import { hasRejected } from "../../lab/labState";
import { ExportMenu } from "../../features/export/ExportMenu";
import { LibraryButton } from "../../features/library/LibraryButton";
import { ShareRun } from "../../features/share/ShareRun";
import { SweepButton } from "../../features/sweep/SweepButton";
import { IconButton } from "../../ui/IconButton";
import classes from "../../ui/shell.module.css";
import { StatusLine } from "./StatusLine";

export function LabTools({ presets }: { readonly presets: readonly Preset[] }) {
  const { lab } = useLabContext();
  const canUndo = useLab(
    (state) => state.shared === null && (hasRejected(state) || (state.history?.past.length ?? 0) > 0),
  );
  const canRedo = useLab((state) => state.shared === null && (state.history?.future.length ?? 0) > 0);
  return (
    <>
      <LibraryButton presets={presets} />
      <IconButton label="Undo" disabled={!canUndo} onClick={lab.undo}>
        <IconArrowBackUp size={18} stroke={1.7} />
      </IconButton>
      <IconButton label="Redo" disabled={!canRedo} onClick={lab.redo}>
        <IconArrowForwardUp size={18} stroke={1.7} />
      </IconButton>
      <StatusLine position="header" />
      <span className={classes.grow} />
      <SweepButton />
      <ShareRun />
      <ExportMenu />
    </>
  );
}
