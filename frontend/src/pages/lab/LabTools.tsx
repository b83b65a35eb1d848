/** What the lab puts into the header: library, undo and redo, what the last answer cost, sweep, share and export. */

import { Text } from "@mantine/core";
import { IconArrowBackUp, IconArrowForwardUp } from "../../ui/icons";
import type { Preset } from "../../api/types";
import { useActionButton } from "../../lab/actions";
import { useLab } from "../../lab/context";
import { ExportMenu } from "../../features/export/ExportMenu";
import { LibraryButton } from "../../features/library/LibraryButton";
import { ShareRun } from "../../features/share/ShareRun";
import { SweepButton } from "../../features/sweep/SweepButton";
import { IconButton } from "../../ui/IconButton";
import classes from "../../ui/shell.module.css";
import type { Result } from "../../lab/result";

export function LabTools({ presets }: { readonly presets: readonly Preset[] }) {
  return (
    <>
      <LibraryButton presets={presets} />
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

const ms = (value: number) => `${value < 9.5 ? value.toFixed(1) : value.toFixed(0)} ms`;

function describe({ source, timing }: Result): string {
  const { cached, computed, computeMs, roundTripMs, opened } = timing;
  if (opened) return `Stored result, opened in ${ms(roundTripMs)}`;
  const parts = [
    cached > 0 ? `${cached} from store` : "",
    computed > 0 ? `${computed} computed in ${ms(computeMs)}` : "",
  ];
  return `${source === "live" ? "Live" : "Up to date"}: ${parts.filter(Boolean).join(", ")} · ${ms(roundTripMs)} in all`;
}

interface Props {
  /** Where it stands: in the header, or under it where the header has no room. */
  readonly position: "header" | "page";
}

/** Whether the shown answer was stored or computed, and what it cost. */
export function StatusLine({ position }: Props) {
  const shown = useLab((state) => state.shown);
  const behind = useLab((state) => state.stale && !state.busy);
  return (
    <Text
      className={classes.status}
      data-position={position}
      data-testid={`status-${position}`}
      title={shown ? `Computed by core ${shown.coreVersion}` : ""}
    >
      {shown ? (behind ? "The last result: the form has changed since" : describe(shown)) : "\u00a0"}
    </Text>
  );
}
