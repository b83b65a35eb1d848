/** What an entry of a list has: a menu, and a form that renames it. */

import { ActionIcon, Button, Group, Menu, TextInput } from "@mantine/core";
import { useEffect, useRef, useState, type ReactNode, type Ref, type SyntheticEvent } from "react";
import { Icon } from "./icons";

/** What a form does in place of leaving the page. */
export const submits = (act: () => void) => (event: SyntheticEvent) => {
  event.preventDefault();
  act();
};

interface MenuProps {
  readonly label: string;
  readonly ref?: Ref<HTMLButtonElement>;
  readonly autoFocus?: boolean;
  /** Its items. */
  readonly children: ReactNode;
}

export function MoreMenu({ label, children, ...button }: MenuProps) {
  return (
    <Menu position="bottom-end" width={160}>
      <Menu.Target>
        <ActionIcon
          variant="subtle"
          color="gray"
          size={28}
          pos="absolute"
          top="0.3rem"
          right="0.2rem"
          aria-label={label}
          {...button}
        >
          <Icon name="Dots" size={16} />
        </ActionIcon>
      </Menu.Target>
      <Menu.Dropdown>{children}</Menu.Dropdown>
    </Menu>
  );
}

interface Props {
  readonly name: string;
  /** What the entry is called. */
  readonly label: string;
  readonly action: string;
  readonly longest: number;
  readonly error: string | null | undefined;
  readonly saving?: boolean;
  readonly onSave: (name: string) => void;
  readonly onClose: () => void;
}

export function NameForm({ name, label, action, longest, error, saving = false, onSave, onClose }: Props) {
  const [typed, setTyped] = useState(name);
  const entry = useRef<HTMLInputElement>(null);
  // Not at once: the menu that it was chosen from would take the focus back.
  useEffect(() => entry.current?.focus(), []);
  return (
    <Group component="form" gap="0.4rem" p="0.2rem 0.4rem 0.6rem" onSubmit={submits(() => onSave(typed))}>
      <TextInput
        ref={entry}
        flex={1}
        aria-label={label}
        placeholder="Name"
        maxLength={longest}
        value={typed}
        error={error}
        onChange={(event) => setTyped(event.currentTarget.value)}
      />
      <Button variant="filled" type="submit" loading={saving}>
        {action}
      </Button>
      <Button onClick={onClose}>Close</Button>
    </Group>
  );
}
