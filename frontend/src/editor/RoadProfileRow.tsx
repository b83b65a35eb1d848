/** A measured road in place of a made one: opened from a CSV file, with what was done to it. */

import { Button, FileButton, List, Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useRef, useState } from "react";
import { api } from "../api/client";
import { useEdit } from "../state/context";
import { roadQuery } from "../state/queries";
import { Fault } from "../ui/Fault";
import classes from "./editor.module.css";
import { FieldFrame } from "./FieldFrame";
import { onRoad } from "./measuredRoad";
import type { TextField } from "./schema";
import { useLeaf } from "./useLeaf";

const LONGEST = 4 * 1024 * 1024;

export function RoadProfileRow({ field }: { readonly field: TextField }) {
  const edit = useEdit();
  const leaf = useLeaf(field.pointer, field.standard);
  const id = typeof leaf.value === "string" ? leaf.value : "";
  const road = useQuery(roadQuery(id)).data;
  const [warnings, setWarnings] = useState<readonly string[]>([]);
  const [wrong, setWrong] = useState<string | null>(null);
  const [sending, setSending] = useState(false);
  const resetFile = useRef<() => void>(null);

  const open = async (file: File | null) => {
    if (file === null) return;
    resetFile.current?.(); // the same file may be sent again
    setSending(true);
    setWrong(null);
    setWarnings([]);
    try {
      if (file.size > LONGEST) throw new Error("A file may have 4 MiB");
      const sent = await api.sendRoad(await file.text());
      setWarnings(sent.warnings);
      edit.commit(onRoad(edit.newest(), sent));
    } catch (error) {
      setWrong(`${file.name}: ${error instanceof Error ? error.message : String(error)}`);
    } finally {
      setSending(false);
    }
  };
  const found = road?.bumps.map(({ start, width, height }) => `${(1000 * height).toFixed(0)} mm at ${start} m over ${width} m`) ?? [];

  return (
    <FieldFrame
      id={`profile-${field.pointer}`}
      {...{ field, leaf }}
      standard="none"
      aside={
        !leaf.readOnly && (
          <FileButton resetRef={resetFile} accept="text/csv,.csv,.txt" inputProps={{ "aria-label": "Road file" }} onChange={(file) => void open(file)}>
            {(props) => (
              <Button {...props} size="compact-xs" variant="default" loading={sending}>
                Open CSV
              </Button>
            )}
          </FileButton>
        )
      }
    >
      {road && (
        <Text className={classes.note}>
          {road.length} m measured, in place of roughness and seed.{" "}
          {found.length > 0 ? `Bumps in it: ${found.join(", ")}.` : "No bump was found in it."}
        </Text>
      )}
      {id !== "" && warnings.length > 0 && (
        <List size="xs" className={classes.note ?? ""}>
          {warnings.map((warning) => (
            <List.Item key={warning}>{warning}</List.Item>
          ))}
        </List>
      )}
      {wrong !== null && <Fault>{wrong}</Fault>}
    </FieldFrame>
  );
}
