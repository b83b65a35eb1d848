/** Renames something in its list. */

import { Button, TextInput } from "@mantine/core";
import { useEffect, useRef, useState } from "react";

interface Props {
  readonly name: string;
  /** What the entry is called. */
  readonly label: string;
  readonly action: string;
  readonly longest: number;
  readonly className: string | undefined;
  readonly error: string | null | undefined;
  readonly saving?: boolean;
  readonly onSave: (name: string) => void;
  readonly onClose: () => void;
}

export function NameForm({ name, label, action, longest, className, error, saving = false, onSave, onClose }: Props) {
  const [typed, setTyped] = useState(name);
  const entry = useRef<HTMLInputElement>(null);
  // Not at once: the menu that it was chosen from would take the focus back.
  useEffect(() => entry.current?.focus(), []);
  return (
    <form
      className={className}
      onSubmit={(event) => {
        event.preventDefault();
        onSave(typed);
      }}
    >
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
    </form>
  );
}
