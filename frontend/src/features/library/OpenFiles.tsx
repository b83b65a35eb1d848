/** A button that opens files in the lab. */

import { Button, FileButton } from "@mantine/core";
import { useRef } from "react";
import type { Kind } from "../../scenario/library";
import { useOpenFiles } from "./open";

interface Props {
  readonly children: string;
  /** Its name for who cannot see its place. */
  readonly name: string;
  /** What is taken of a file that has more. */
  readonly wanted?: Kind;
  readonly size?: "compact-xs" | "xs";
}

export function OpenFiles({ children, name, wanted, size = "compact-xs" }: Props) {
  const open = useOpenFiles();
  const reset = useRef<() => void>(null);
  const choose = (files: readonly File[]) => {
    if (files.length === 0) return;
    reset.current?.(); // the same file may be opened again
    void open(files, wanted);
  };
  return (
    <FileButton
      multiple
      resetRef={reset}
      accept=".json,.csv,.txt,application/json,text/csv"
      inputProps={{ "aria-label": name }}
      onChange={choose}
    >
      {(props) => (
        <Button {...props} size={size} variant="default">
          {children}
        </Button>
      )}
    </FileButton>
  );
}
