/** Opens a form anew that somebody has edited. */

import { Button } from "@mantine/core";

export function ResetDraft({ onReset }: { readonly onReset: () => void }) {
  return (
    <Button variant="subtle" color="gray" ml="auto" type="button" onClick={onReset}>
      Reset
    </Button>
  );
}
