/** Files dropped anywhere on the lab, and what the library has done last. */

import { CloseButton, Portal, Text } from "@mantine/core";
import { useWindowEvent } from "@mantine/hooks";
import { useState } from "react";
import { useScenario } from "../../lab/context";
import { useStore } from "../../lib/store";
import ui from "../../ui/ui.module.css";
import classes from "./library.module.css";
import { notice, useOpenFiles } from "./open";
import { dialog } from "../../scenario/ownLibrary";

const hasFiles = ({ dataTransfer }: DragEvent) => dataTransfer?.types.includes("Files") === true;

export function DropFiles() {
  const openFiles = useOpenFiles();
  const [isOver, setOver] = useState(false);
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
      {isOver && <div className={classes.drop}>Drop scenarios, vehicles or measured roads</div>}
      <LastNotice />
    </Portal>
  );
}

function LastNotice() {
  const said = useStore(notice);
  const scenario = useScenario();
  const isOpen = useStore(dialog) !== null;
  if (said?.scenario !== scenario || isOpen) return null;
  return (
    <div className={classes.message}>
      <div className={ui.notice} role={said.isWrong ? "alert" : "status"}>
        <div>
          {said.lines.map((line) => (
            <Text key={line} size="sm">
              {line}
            </Text>
          ))}
        </div>
        <CloseButton size="sm" aria-label="Close the message" onClick={() => notice.set(null)} />
      </div>
    </div>
  );
}
