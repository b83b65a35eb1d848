/** Question marks that open the manual, in a tab of its own, where it says what a name means. */

import { ActionIcon, Tooltip } from "@mantine/core";
import { memo } from "react";
import { IconHelp } from "./icons";
import ui from "./ui.module.css";

export const MANUAL = "/manual/";
const NAMES = `${MANUAL}reference/scenario/`;
const OWN_CONTROLLERS = `${MANUAL}how-to/own-controller/`;
const RECORDINGS = `${MANUAL}tutorials/validate/`;

/** The strategies side by side. */
export const STRATEGIES = `${NAMES}#strategies`;

/** Of a field's dotted name, a signal's or an event's key, a strategy's id. What is one's own is in no list. */
export const placeOf = (name: string): string =>
  name.startsWith("own.") ? OWN_CONTROLLERS : name.startsWith("recording:") ? RECORDINGS : `${NAMES}#${name}`;

const BY_POINTER_OR_KEY = { hover: true, focus: true, touch: false }; // a tap opens the manual

interface Props {
  /** As of `placeOf`. */
  readonly name: string;
  readonly label: string;
  /** Said while it is pointed at. */
  readonly text?: string;
}

export const ManualLink = memo(function ManualLink({ name, label, text = "" }: Props) {
  return (
    <Tooltip label={text === "" ? "What it is" : text} multiline maw={240} withArrow events={BY_POINTER_OR_KEY}>
      <ActionIcon
        component="a"
        href={placeOf(name)}
        target="_blank"
        className={ui.manualLink ?? ""}
        variant="transparent"
        size={24}
        data-unprinted
        aria-label={`About ${label}, in the manual${text === "" ? "" : `: ${text}`}`}
      >
        <IconHelp size={14} stroke={1.6} />
      </ActionIcon>
    </Tooltip>
  );
});
