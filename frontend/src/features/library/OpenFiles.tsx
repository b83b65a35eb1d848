/** A button that opens files in the lab. */

import { Box, Button, FileButton, CloseButton, Portal, Text } from "@mantine/core";
import { lazy, useEffect, useEffectEvent, useRef, useState } from "react";
import { useWindowEvent } from "@mantine/hooks";
import { type ItemKind, dialog } from "../../scenario/library";
import { LazyPart } from "../../ui/LazyPart";
import { useOpenFiles, useOpenGalleryEntry, notice, unclear } from "./open";
import { useFromScenario } from "../../lab/context";
import { useSelector } from "@tanstack/react-store";
import ui from "../../ui/ui.module.css";
import { count } from "../../units/format";

const FileMapping = lazy(() => import("./FileMapping").then((module) => ({ default: module.FileMapping })));

interface Props {
  readonly children: string;
  /** Its accessible name. */
  readonly name: string;
  /** What is taken of a file that has more. */
  readonly wanted?: ItemKind;
  readonly size?: "compact-xs" | "xs";
}

export function OpenFiles({ children, name, wanted, size = "compact-xs" }: Props) {
  const open = useOpenFiles();
  const reset = useRef<() => void>(null);
  const choose = (files: readonly File[]) => {
    if (files.length === 0) return;
    reset.current?.(); // the same file may be opened again
    void open(files, { wanted });
  };
  return (
    <FileButton
      multiple
      resetRef={reset}
      accept=".json,.csv,.txt,.crg,.dat,.asc,.tsv,.erd,.vbo,.xlsx,application/json,text/csv"
      inputProps={{ "aria-label": name }}
      onChange={choose}
    >
      {(props) => (
        <Button {...props} size={size}>
          {children}
        </Button>
      )}
    </FileButton>
  );
}

const hasFiles = ({ dataTransfer }: DragEvent) => dataTransfer?.types.includes("Files") === true;

/** Files dropped anywhere on the lab, the gallery's scenario that the address names, and what the library has done last. */
export function DropFiles() {
  const openFiles = useOpenFiles();
  const openGalleryEntry = useEffectEvent(useOpenGalleryEntry());
  useEffect(() => void openGalleryEntry(), []);
  const [isOver, setOver] = useState(false);
  const isAsked = useSelector(unclear).length > 0;
  useWindowEvent("dragover", (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault(); // the browser would leave the page for the file
    setOver(true);
  });
  useWindowEvent("dragleave", ({ relatedTarget }) => {
    if (relatedTarget === null) setOver(false);
  });
  useWindowEvent("drop", (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    setOver(false);
    void openFiles([...(event.dataTransfer?.files ?? [])]);
  });
  return (
    <Portal>
      {isAsked && (
        <LazyPart onClose={() => unclear.set([])}>
          <FileMapping />
        </LazyPart>
      )}
      {isOver && (
        <Box pos="fixed" inset="0.5rem" bd="3px dashed var(--accent)" bdrs={12} fz="lg" fw={650} style={DROP}>
          Drop scenarios, vehicles, measured roads or recorded drives
        </Box>
      )}
      <LastNotice />
    </Portal>
  );
}

const DROP = {
  zIndex: 400,
  display: "grid",
  placeItems: "center",
  background: "color-mix(in srgb, var(--surface) 88%, transparent)",
  pointerEvents: "none",
} as const;

/** Over the form's sheet on a phone. */
const MESSAGE = { zIndex: 300, transform: "translateX(-50%)" };

function LastNotice() {
  const said = useSelector(notice);
  const isNewest = useFromScenario((scenario) => said?.scenario === scenario);
  const isOpen = useSelector(dialog) !== null;
  const isAsked = useSelector(unclear).length > 0; // whose dialog says what is wrong
  if (!said || !isNewest || isOpen || isAsked) return null;
  const [first, ...remarks] = said.lines;
  const isLong = !said.isWrong && remarks.length > 1; // it would cover the verdict
  const rest = remarks.map((line) => <Text key={line}>{line}</Text>);
  return (
    <Box pos="fixed" top="3.85rem" left="50%" w="max-content" maw="calc(100% - 2rem)" style={MESSAGE} data-unprinted>
      <div className={ui.notice} role={said.isWrong ? "alert" : "status"}>
        <div>
          <Text>{first}</Text>
          {isLong ? (
            <details>
              <summary>{count(remarks.length, "remark")}</summary>
              {rest}
            </details>
          ) : (
            rest
          )}
        </div>
        <CloseButton size="sm" aria-label="Close the message" onClick={() => notice.set(null)} />
      </div>
    </Box>
  );
}
