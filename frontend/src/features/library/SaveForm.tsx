/** Saves the scenario or the vehicle that is edited under a name. */

import { Button, SegmentedControl, Text, TextInput } from "@mantine/core";
import { useState } from "react";
import type { JsonObject } from "../../api/types";
import { changedFields, changesText, completed } from "../../scenario/differences";
import { sameValue } from "../../scenario/path";
import type { Group } from "../../scenario/schema";
import { LONGEST_NAME } from "../../scenario/library";
import { useEdit, useScenario } from "../../lab/context";
import { formatMinute } from "../../units/dates";
import { Fault } from "../../ui/Fault";
import { cleanName, type Kind } from "../../scenario/library";
import classes from "./library.module.css";
import { notice, useExportItem } from "./open";
import { ownLibrary, useItems } from "../../scenario/ownLibrary";

type Saved = Exclude<Kind, "road">;

interface Props {
  readonly form: Group;
  /** What it offers first. */
  readonly kind: Saved;
  readonly onSaved: () => void;
}

export function SaveForm({ form, kind: first, onSaved }: Props) {
  const edit = useEdit();
  const exportItem = useExportItem();
  const scenario = completed(form, useScenario());
  const [kind, setKind] = useState(first);
  const [typed, setTyped] = useState<string | null>(null);
  const [wrong, setWrong] = useState<string | null>(null);
  const value = kind === "vehicle" ? (scenario.vehicle as JsonObject) : scenario;
  const items = useItems(kind);
  const described = kind === "vehicle" ? "" : changesText(changedFields(form, completed(form, {}), scenario), 2);
  const name = cleanName(typed ?? items.find((item) => sameValue(item.value, value))?.name ?? described);
  const replaced = items.find((item) => item.name === name);
  const save = () => {
    try {
      ownLibrary.save(kind, name, value);
      notice.set({ lines: [`The ${kind} is in the library as “${name}”.`], isWrong: false, scenario: edit.newest() });
      onSaved();
    } catch (error) {
      setWrong(error instanceof Error ? error.message : String(error));
    }
  };
  return (
    <form
      className={classes.save}
      onSubmit={(event) => {
        event.preventDefault();
        if (name !== "") save();
      }}
    >
      <SegmentedControl
        size="xs"
        aria-label="What is saved"
        value={kind}
        data={[
          { value: "scenario", label: "This scenario" },
          { value: "vehicle", label: "Its vehicle" },
        ]}
        onChange={setKind}
      />
      <TextInput
        size="xs"
        className={classes.grow ?? ""}
        aria-label="Name"
        placeholder="Name"
        data-autofocus
        maxLength={LONGEST_NAME}
        value={typed ?? name.slice(0, LONGEST_NAME)}
        onChange={(event) => setTyped(event.currentTarget.value)}
      />
      <Button type="submit" size="xs" disabled={name === ""}>
        {replaced ? "Replace" : "Save"}
      </Button>
      <Button size="xs" variant="default" disabled={name === ""} onClick={() => void exportItem({ kind, name, value })}>
        Export
      </Button>
      <Text className={classes.text} role="status">
        {replaced
          ? `Replaces the ${kind} that was saved under this name on ${formatMinute(replaced.saved)}.`
          : "\u00a0"}
      </Text>
      {wrong !== null && <Fault>{wrong}</Fault>}
    </form>
  );
}
