/** Question marks that open the manual, in a tab of its own, where it says what a name means. */

import { ActionIcon } from "@mantine/core";
import { memo } from "react";
import { Icon } from "./icons";
import { placeOf } from "./manual";
import ui from "./ui.module.css";

interface Props {
  /** As of `placeOf`. */
  readonly name: string;
  readonly label: string;
  /** Said while it is pointed at. */
  readonly text?: string;
}

export const ManualLink = memo(function ManualLink({ name, label, text = "" }: Props) {
  return (
    <ActionIcon
      data-hint={text === "" ? "What it is" : text}
      component="a"
      href={placeOf(name)}
      target="_blank"
      className={ui.manualLink ?? ""}
      variant="transparent"
      size={24}
      data-unprinted
      aria-label={`About ${label}, in the manual${text === "" ? "" : `: ${text}`}`}
    >
      <Icon name="Help" size={14} stroke={1.6} />
    </ActionIcon>
  );
});
