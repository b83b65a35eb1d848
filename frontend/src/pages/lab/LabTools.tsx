/** What the lab puts into the header: library, undo and redo, what the last answer cost, sweep, share and export. */

import { IconArrowBackUp, IconArrowForwardUp } from "../../ui/icons";
import { useActionButton } from "../../lab/actions";
import { ExportMenu } from "../../features/export/ExportMenu";
import { LibraryButton } from "../../features/library/LibraryButton";
import { ShareRun } from "../../features/share/ShareRun";
import { SweepButton } from "../../features/sweep/SweepButton";
import { IconButton } from "../../ui/IconButton";
import classes from "../../ui/shell.module.css";
import { StatusLine } from "./StatusLine";

export function LabTools() {
  return (
    <>
      <LibraryButton />
      <IconButton {...useActionButton("undo")}>
        <IconArrowBackUp size={18} stroke={1.7} />
      </IconButton>
      <IconButton {...useActionButton("redo")}>
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
