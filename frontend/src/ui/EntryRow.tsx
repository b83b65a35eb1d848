/** An entry of a form's list: its title, what stands beside it, its own inputs and its error; it can be removed. */

import { ActionIcon } from "@mantine/core";
import type { ReactNode } from "react";
import { IconX } from "../icons";
import { Fault } from "./Fault";
import ui from "./ui.module.css";

interface Props {
  readonly title: string;
  /** Its name for who cannot see its place. */
  readonly name?: string;
  /** What is removed; the title where it is left out. */
  readonly removal?: string;
  readonly beside: ReactNode;
  readonly error: string | undefined;
  readonly onRemove: () => void;
  readonly children?: ReactNode;
}

export function EntryRow({ title, name = title, removal = title, beside, error, onRemove, children }: Props) {
  return (
    <div className={ui.entry} role="group" aria-label={name} data-error={error !== undefined || undefined}>
      <div className={ui.entryHead}>
        <span className={ui.entryTitle}>{title}</span>
        {beside}
        <ActionIcon className={ui.entryRemove ?? ""} size={24} variant="subtle" color="gray" aria-label={`Remove ${removal}`} onClick={onRemove}>
          <IconX size={15} />
        </ActionIcon>
      </div>
      {children}
      {error !== undefined && <Fault>{error}</Fault>}
    </div>
  );
}
