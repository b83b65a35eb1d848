/** Opens a form anew that somebody has edited. */

import { Button } from "@mantine/core";

/** It stays where there is nothing to reset: a button that went away would take the keyboard's place with it. */
export function ResetDraft({ isEdited, onReset }: { readonly isEdited: boolean; readonly onReset: () => void }) {
  return (
    <Button
      variant="subtle"
      color="gray"
      ml="auto"
      type="button"
      {...(isEdited ? { onClick: onReset } : { "aria-disabled": true, "data-disabled": true })}
    >
      Reset
    </Button>
  );
}
