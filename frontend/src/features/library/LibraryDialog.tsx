/** One's own scenarios, vehicles, roads and sets of requirements, and the presets: saved, opened, renamed, deleted, imported and exported. */

import { Box, Button, Group, Modal, Text, SegmentedControl, TextInput, Menu } from "@mantine/core";
import { useState, useRef } from "react";
import claims from "../../../../examples/paper-claims.json";
import type { Preset, JsonObject, Requirement } from "../../api/types";
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
import { useOpenItem, notice, useExportItem } from "./open";
import { OpenFiles } from "./OpenFiles";
import { Template } from "./Template";
import { changedFields, changesText, completed } from "../../scenario/differences";
import { sameValue } from "../../scenario/path";
import { useEdit, useScenario, useView } from "../../lab/context";
import { formatMinute } from "../../units/dates";
import { Fault } from "../../ui/Messages";
import { requirementsIn, requirementsText } from "../../lab/requirements";
import { MoreMenu, NameForm, submits } from "../../ui/ListEntry";
import { count } from "../../units/format";

const CLAIMS = {
  id: "paper-claims",
  label: "Requirements: what the paper claims",
  description:
    "What its abstract says LV changes against the suspension’s control alone, which has to be the baseline.",
  kind: "requirements" as const,
  value: { requirements: claims as readonly Requirement[] },
};

interface Props {
  readonly form: Form;
  readonly presets: readonly Preset[];
  readonly saving: Exclude<ItemKind, "road">;
  readonly onClose: () => void;
}

export function LibraryDialog({ form, presets, saving, onClose }: Props) {
  const [deleted, setDeleted] = useState<Item | null>(null);
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
      <Box component="h3" m="1rem 0 0.3rem" fz="md" fw={650}>
        Presets
      </Box>
      <ul className={ui.list} aria-label="Presets">
        {[
          ...presets.map(({ scenario, ...preset }) => ({ ...preset, kind: "scenario" as const, value: scenario })),
          CLAIMS,
        ].map(({ id, label, description, kind, value }) => (
          <li key={id} className={ui.item}>
            <button type="button" onClick={() => open({ kind, value })}>
              <span className={ui.itemTitle}>{label}</span>
              <span className={ui.under}>{description}</span>
            </button>
          </li>
        ))}
      </ul>
    </Modal>
  );
}

interface ListProps {
  readonly title: string;
  readonly kind: ItemKind;
  readonly form: Form;
  readonly open: (item: Item) => void;
  readonly remove: (item: Item) => void;
}

function OwnItems({ title, kind, ...row }: ListProps) {
  const items = useItems(kind);
  const [renamed, setRenamed] = useState<string | null>(null);
  if (items.length === 0) return null;
  return (
    <>
      <Box component="h3" m="1rem 0 0.3rem" fz="md" fw={650}>
        {title}
      </Box>
      <ul className={ui.list} aria-label={title}>
        {items.map((item) => (
          <ItemRow key={item.name} item={item} isRenamed={item.name === renamed} onRenamed={setRenamed} {...row} />
        ))}
      </ul>
    </>
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

interface ItemRowProps {
  readonly item: Item;
  readonly form: Form;
  readonly open: (item: Item) => void;
  readonly remove: (item: Item) => void;
  /** It has just got its name: the focus is on its menu, as it was before. */
  readonly isRenamed: boolean;
  readonly onRenamed: (name: string) => void;
}

/** A scenario and a vehicle by what differs from the paper's. */
function describe({ kind, value }: Item, form: Form): string {
  if (kind === "road") {
    const bumps = Array.isArray(value.bumps) ? value.bumps.length : 0;
    return `${typeof value.length === "number" ? value.length : "?"} m, ${count(bumps, "bump")} in it`;
  }
  if (kind === "requirements") return requirementsText(requirementsIn(value.requirements)).replaceAll(";", "; ");
  const paper = completed(form, {});
  const scenario = kind === "scenario" ? value : { ...paper, vehicle: value };
  return changesText(changedFields(form, paper, completed(form, scenario))) || "As in the paper";
}

function ItemRow({ item, form, open, remove, isRenamed, onRenamed }: ItemRowProps) {
  const [isRenaming, setRenaming] = useState(false);
  const menu = useRef<HTMLButtonElement>(null);
  const exportItem = useExportItem();
  const { name, saved } = item;
  return (
    <li className={ui.item}>
      <button type="button" onClick={() => open(item)}>
        <span className={ui.itemTitle}>{name}</span>
        <span className={ui.under}>
          {describe(item, form)} · {formatMinute(saved)}
        </span>
      </button>
      <MoreMenu ref={menu} autoFocus={isRenamed} label={`Rename, export or delete ${name}`}>
        <Menu.Item onClick={() => setRenaming(true)}>Rename</Menu.Item>
        <Menu.Item onClick={() => void exportItem(item)}>Export as a file</Menu.Item>
        <Menu.Item onClick={() => remove(item)}>Delete</Menu.Item>
      </MoreMenu>
      {isRenaming && (
        <Rename
          item={item}
          onRenamed={onRenamed}
          onClose={() => {
            setRenaming(false);
            menu.current?.focus();
          }}
        />
      )}
    </li>
  );
}

interface RenameProps extends Pick<ItemRowProps, "item" | "onRenamed"> {
  readonly onClose: () => void;
}

function Rename({ item, onRenamed, onClose }: RenameProps) {
  const [wrong, setWrong] = useState<string | null>(null);
  const rename = (name: string) => {
    try {
      ownLibrary.rename(item, name);
      onRenamed(cleanName(name));
      onClose();
    } catch (error) {
      setWrong(error instanceof Error ? error.message : String(error));
    }
  };
  return (
    <NameForm
      name={item.name}
      label="New name"
      action="Rename"
      longest={LONGEST_NAME}
      error={wrong}
      onSave={rename}
      onClose={onClose}
    />
  );
}
