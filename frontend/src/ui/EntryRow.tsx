/** An entry of a form's list: its title, what stands beside it, its own inputs and its error; it can be removed. */

import { ActionIcon, Box, Group } from "@mantine/core";
import type { ReactNode } from "react";
import { IconX } from "./icons";
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
      <Group gap="0.1rem 0.7rem" pos="relative" pr="1.8rem">
        <Box component="span" fz="sm" fw={600}>
          {title}
        </Box>
        {beside}
        <ActionIcon
          pos="absolute"
          top={0}
          right={0}
          size={24}
          variant="subtle"
          color="gray"
          aria-label={`Remove ${removal}`}
          onClick={onRemove}
        >
          <IconX size={15} />
        </ActionIcon>
      </Group>
      {children}
      {error !== undefined && <Fault>{error}</Fault>}
    </div>
  );
}
