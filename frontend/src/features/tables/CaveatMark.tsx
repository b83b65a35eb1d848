/** The caveats of a result; on hover, focus or touch what they mean. */

import { Box, Tooltip } from "@mantine/core";
import { IconAlertTriangle } from "../../ui/icons";
import type { Caveat } from "./caveats";
import classes from "./tables.module.css";

export function CaveatMark({
  caveats,
  short = false,
}: {
  readonly caveats: readonly Caveat[];
  readonly short?: boolean;
}) {
  if (caveats.length === 0) return null;
  const text = caveats.map((caveat) => caveat.text).join(", ");
  const meaning = caveats.map((caveat) => (
    <Box component="span" key={caveat.event} display="block">
      <strong>{caveat.text}</strong> {caveat.description}
    </Box>
  ));
  return (
    <Tooltip label={meaning} multiline w={280} withinPortal events={{ hover: true, focus: true, touch: true }}>
      <button type="button" className={classes.caveat} data-caveat={caveats.map(({ event }) => event).join(" ")}>
        <IconAlertTriangle size={short ? 14 : 12} stroke={2} aria-hidden />
        <span className={short ? "visually-hidden" : ""}>{text}</span>
      </button>
    </Tooltip>
  );
}
