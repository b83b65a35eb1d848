/** Copies the page's address, which is the result's. */

import { Button, Tooltip } from "@mantine/core";
import { IconCheck, IconLink } from "@tabler/icons-react";
import shell from "../shell/shell.module.css";
import { useCopied } from "./useCopied";

export function ShareButton() {
  const { copied, copy } = useCopied();
  return (
    <Tooltip label="Copies an address that opens exactly this">
      <Button
        size="xs"
        variant="light"
        aria-label="Copy link"
        classNames={{ root: shell.compact ?? "", label: shell.compactLabel ?? "", section: shell.compactSection ?? "" }}
        leftSection={copied ? <IconCheck size={15} /> : <IconLink size={15} />}
        onClick={() => copy(window.location.href)}
      >
        {copied ? "Copied" : "Copy link"}
      </Button>
    </Tooltip>
  );
}
