/** An address to be read, selected and copied. */

import { ActionIcon, TextInput, Tooltip } from "@mantine/core";
import { IconCheck, IconCopy } from "../../ui/icons";
import { useEffect, useRef } from "react";
import { useCopied } from "../../ui/useCopied";

export function LinkField({ url }: { readonly url: string }) {
  const input = useRef<HTMLInputElement>(null);
  const { copied, copy } = useCopied();
  useEffect(() => {
    input.current?.focus();
    input.current?.setSelectionRange(0, url.length, "backward"); // so that its beginning is in sight
  }, [url]);
  return (
    <TextInput
      ref={input}
      size="xs"
      readOnly
      data-autofocus
      aria-label="Address of the link"
      value={url}
      onFocus={(event) => event.currentTarget.select()}
      rightSection={
        <Tooltip label={copied ? "Copied" : "Copy"}>
          <ActionIcon
            size={24}
            variant="subtle"
            aria-label={copied ? "Copied" : "Copy the address"}
            onClick={() => copy(url)}
          >
            {copied ? <IconCheck size={15} /> : <IconCopy size={15} />}
          </ActionIcon>
        </Tooltip>
      }
    />
  );
}
