/** A button that is only a picture: its name is its label and its tooltip. */

import { ActionIcon } from "@mantine/core";
import type { ReactNode } from "react";
import ui from "./ui.module.css";

interface Props {
  readonly label: string;
  readonly disabled?: boolean;
  readonly onClick: () => void;
  readonly children: ReactNode;
}

export function IconButton({ label, disabled = false, onClick, children }: Props) {
  return (
    <ActionIcon data-hint={label} variant="subtle" size={32} aria-label={label} disabled={disabled} onClick={onClick}>
      {children}
    </ActionIcon>
  );
}

/** A button of a header that is only its icon where there is little room. */
export const compact = { root: ui.compact ?? "", label: ui.compactLabel ?? "", section: ui.compactSection ?? "" };
