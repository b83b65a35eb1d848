/** One's own scenarios, vehicles, roads and sets of requirements, the presets and the vehicles with sources: saved, opened, renamed, deleted, imported and exported. */

import { Button, Group, Modal, Text, SegmentedControl, TextInput } from "@mantine/core";
import { useState } from "react";
import { useQuery } from "@tanstack/react-query";
import claims from "../../../../examples/paper-claims.json";
import type { Preset, JsonObject } from "../../api/types";
import type { Group as Form } from "../../scenario/schema";
import {
  type Item,
  type ItemKind,
  kindWord,
  ownLibrary,
  useItems,
  LONGEST_NAME,
  cleanName,
} from "../../scenario/library";
import ui from "../../ui/ui.module.css";
import type { Content } from "../../scenario/withItem";
import { useOpenItem, notice, useExportItem } from "./open";
import { OwnItems, Titled } from "./OwnItems";
import { OpenFiles } from "./OpenFiles";
import { Template } from "./Template";
import { changedFields, changesText, completed } from "../../scenario/differences";
import { sameValue } from "../../scenario/path";
import { useEdit, useScenario, useView } from "../../lab/context";
import { formatMinute } from "../../units/dates";
import { Fault } from "../../ui/Messages";
import { vehiclesQuery } from "../../server/queries";
import { submits } from "../../ui/ListEntry";

/** What there is for everybody, and what it is or where it comes from. */
type Provided = Content & { readonly id: string; readonly label: string; readonly description: string };

const CLAIMS: Provided = {
  id: "paper-claims",
  label: "Requirements: what the paper claims",
  description:
    "What its abstract says LV changes against the suspension’s control alone, which has to be the baseline.",
  kind: "requirements",
  value: { requirements: claims },
};

interface Props {
  readonly form: Form;
  readonly presets: readonly Preset[];
  readonly saving: Exclude<ItemKind, "road">;
  readonly onClose: () => void;
}

export function LibraryDialog({ form, presets, saving, onClose }: Props) {
  const [deleted, setDeleted] = useState<Item | null>(null);
  const { data: vehicles = [] } = useQuery(vehiclesQuery);
  const provided: Readonly<Record<string, readonly Provided[]>> = {
    Presets: [
      ...presets.map(({ scenario, ...preset }) => ({ ...preset, kind: "scenario" as const, value: scenario })),
      CLAIMS,
    ],
    Vehicles: vehicles.map(({ vehicle, sources, description, ...each }) => ({
      ...each,
      kind: "vehicle",
      value: vehicle,
      description: [description, ...sources].join(" "),
    })),
  };
  const openItem = useOpenItem();
  const open: typeof openItem = (item) => {
    onClose();
    openItem(item);
  };
  const remove = (item: Item) => {
    ownLibrary.remove(item);
    setDeleted(item);
  };
  const restore = (item: Item) => {
    ownLibrary.restore(item);
    setDeleted(null);
  };
  return (
    <Modal opened onClose={onClose} title="Library" size="xl">
      <SaveForm form={form} kind={saving} onSaved={onClose} />
      <Group gap="0.4rem" mt="0.5rem">
        <OpenFiles name="Files for the library" size="xs">
          Import files
        </OpenFiles>
        <Text flex="1 1 16rem" size="xs" lh="1.4" c="dimmed">
          Scenarios, vehicles and requirements as JSON, measured roads as CSV or OpenCRG, recorded drives as CSV; or
          drop them anywhere on the lab. This browser keeps the library: export what others need. <Template />.
        </Text>
      </Group>
      {deleted && (
        <div className={ui.banner}>
          <Text flex={1} role="status">
            Deleted the {kindWord(deleted.kind)} “{deleted.name}”.
          </Text>
          <Button size="compact-xs" autoFocus onClick={() => restore(deleted)}>
            Undo
          </Button>
        </div>
      )}
      <OwnItems title="Your scenarios" kind="scenario" {...{ form, open, remove }} />
      <OwnItems title="Your vehicles" kind="vehicle" {...{ form, open, remove }} />
      <OwnItems title="Your measured roads" kind="road" {...{ form, open, remove }} />
      <OwnItems title="Your sets of requirements" kind="requirements" {...{ form, open, remove }} />
      {Object.entries(provided).map(([title, items]) => (
        <Titled key={title} title={title}>
          {items.map(({ id, label, description, ...item }) => (
            <li key={id} className={ui.item}>
              <button type="button" onClick={() => open(item)}>
                <span className={ui.itemTitle}>{label}</span>
                <span className={ui.under}>{description}</span>
              </button>
            </li>
          ))}
        </Titled>
      ))}
    </Modal>
  );
}

type Saved = Exclude<ItemKind, "road">;

interface SaveFormProps {
  readonly form: Form;
  /** What it offers first. */
  readonly kind: Saved;
  readonly onSaved: () => void;
}

/** Saves the scenario or the vehicle that is edited under a name. */
function SaveForm({ form, kind: first, onSaved }: SaveFormProps) {
  const edit = useEdit();
  const exportItem = useExportItem();
  const scenario = completed(form, useScenario());
  const { requirements } = useView();
  const [kind, setKind] = useState(first);
  const [typed, setTyped] = useState<string | null>(null);
  const [wrong, setWrong] = useState<string | null>(null);
  const value = { scenario, vehicle: scenario.vehicle as JsonObject, requirements: { requirements } }[kind];
  const items = useItems(kind);
  const described = kind !== "scenario" ? "" : changesText(changedFields(form, completed(form, {}), scenario), 2);
  const name = cleanName(typed ?? items.find((item) => sameValue(item.value, value))?.name ?? described);
  const replaced = items.find((item) => item.name === name);
  const save = () => {
    try {
      ownLibrary.save(kind, name, value);
      notice.set({
        lines: [`The ${kindWord(kind)} is in the library as “${name}”.`],
        isWrong: false,
        scenario: edit.newest(),
      });
      onSaved();
    } catch (error) {
      setWrong(error instanceof Error ? error.message : String(error));
    }
  };
  return (
    <Group
      component="form"
      gap="0.4rem"
      onSubmit={submits(() => {
        if (name !== "") save();
      })}
    >
      <SegmentedControl
        aria-label="What is saved"
        value={kind}
        data={[
          { value: "scenario", label: "This scenario" },
          { value: "vehicle", label: "Its vehicle" },
          { value: "requirements", label: "Its requirements", disabled: requirements.length === 0 },
        ]}
        onChange={setKind}
      />
      <TextInput
        flex="1 1 10rem"
        aria-label="Name"
        placeholder="Name"
        data-autofocus
        maxLength={LONGEST_NAME}
        value={typed ?? name.slice(0, LONGEST_NAME)}
        onChange={(event) => setTyped(event.currentTarget.value)}
      />
      <Button variant="filled" type="submit" disabled={name === ""}>
        {replaced ? "Replace" : "Save"}
      </Button>
      <Button disabled={name === ""} onClick={() => void exportItem({ kind, name, value })}>
        Export
      </Button>
      <Text w="100%" size="xs" c="dimmed" role="status">
        {replaced
          ? `Replaces the ${kindWord(kind)} that was saved under this name on ${formatMinute(replaced.saved)}.`
          : "\u00a0"}
      </Text>
      {wrong !== null && <Fault>{wrong}</Fault>}
    </Group>
  );
}
