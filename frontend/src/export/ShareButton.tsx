/** Copies the page's address, which is the result's. */

import { Button, Tooltip } from "@mantine/core";
import { IconCheck, IconLink } from "@tabler/icons-react";
import { useLab } from "../state/context";
import shell from "../shell/shell.module.css";
import { useCopied } from "./useCopied";

export function ShareButton() {
  const { copied, copy } = useCopied();
  // The address is the last exact run's: while the form is ahead of it, it would open something else.
  const exact = useLab((state) => state.shown?.source === "exact" && !state.stale);
  return (
    <Tooltip label={exact ? "Copies an address that opens exactly this" : "There is no result of these values yet"}>
      <Button
        size="xs"
        variant="light"
        aria-label="Copy link"
        classNames={{ root: shell.compact ?? "", label: shell.compactLabel ?? "", section: shell.compactSection ?? "" }}
        leftSection={copied ? <IconCheck size={15} /> : <IconLink size={15} />}
        {...(exact ? {} : { "data-disabled": true })}
        aria-disabled={!exact}
        onClick={() => {
          if (exact) copy(window.location.href);
        }}
      >
        {copied ? "Copied" : "Copy link"}
      </Button>
    </Tooltip>
  );
}
