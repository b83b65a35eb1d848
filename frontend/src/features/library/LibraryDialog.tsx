/** One's own scenarios, vehicles, roads and sets of requirements, the presets and the vehicles with sources: saved, opened, renamed, deleted, imported and exported. */

import { Button, Group, Modal, Text, SegmentedControl, TextInput, Box, Menu } from "@mantine/core";
import { useState, useRef, type ReactNode } from "react";
import { useQuery } from "@tanstack/react-query";
import claims from "../../../../examples/paper-claims.json";
import type { JsonObject } from "../../api/types";
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
import { messageOf } from "../../api/problem";
import { useForm, usePresets } from "../../server/useCatalogues";
import type { Content } from "../../scenario/withItem";
import { useOpenItem, useSay, useExportItem } from "./open";
import { OpenFiles } from "./OpenFiles";
import { Template } from "./Template";
import { changedFields, changesText, completed } from "../../scenario/differences";
import { sameValue } from "../../scenario/path";
import { useScenario, useView } from "../../lab/context";
import { formatMinute, count } from "../../units/format";
import { Fault } from "../../ui/Messages";
import { vehiclesQuery } from "../../server/queries";
import { submits, MoreMenu, NameForm } from "../../ui/ListEntry";
import { requirementsIn, requirementsText } from "../../lab/requirements";

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
  readonly saving: Exclude<ItemKind, "road">;
  readonly onClose: () => void;
}

export function LibraryDialog({ saving, onClose }: Props) {
  const presets = usePresets();
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
  return (
    <Modal opened onClose={onClose} title="Library" size="xl">
      <SaveForm kind={saving} onSaved={onClose} />
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
          <Button
            size="compact-xs"
            autoFocus
            onClick={() => {
              ownLibrary.restore(deleted);
              setDeleted(null);
            }}
          >
            Undo
          </Button>
        </div>
      )}
      <OwnItems title="Your scenarios" kind="scenario" {...{ open, remove }} />
      <OwnItems title="Your vehicles" kind="vehicle" {...{ open, remove }} />
      <OwnItems title="Your measured roads" kind="road" {...{ open, remove }} />
      <OwnItems title="Your sets of requirements" kind="requirements" {...{ open, remove }} />
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

interface SaveFormProps {
  /** What it offers first. */
  readonly kind: Props["saving"];
  readonly onSaved: () => void;
}

/** Saves the scenario or the vehicle that is edited under a name. */
function SaveForm({ kind: first, onSaved }: SaveFormProps) {
  const form = useForm();
  const say = useSay();
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
      say([`The ${kindWord(kind)} is in the library as “${name}”.`]);
      onSaved();
    } catch (error) {
      setWrong(messageOf(error));
    }
  };
  return (
    <Group component="form" gap="0.4rem" onSubmit={submits(name === "" ? () => undefined : save)}>
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

function Titled({ title, children }: { readonly title: string; readonly children: ReactNode }) {
  return (
    <>
      <Box component="h3" m="1rem 0 0.3rem" fz="md" fw={650}>
        {title}
      </Box>
      <ul className={ui.list} aria-label={title}>
        {children}
      </ul>
    </>
  );
}

interface ListProps extends Pick<ItemRowProps, "open" | "remove"> {
  readonly title: string;
  readonly kind: ItemKind;
}

function OwnItems({ title, kind, ...row }: ListProps) {
  const items = useItems(kind);
  const [renamed, setRenamed] = useState<string | null>(null);
  if (items.length === 0) return null;
  return (
    <Titled title={title}>
      {items.map((item) => (
        <ItemRow key={item.name} item={item} isRenamed={item.name === renamed} onRenamed={setRenamed} {...row} />
      ))}
    </Titled>
  );
}

interface ItemRowProps {
  readonly item: Item;
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

function ItemRow({ item, open, remove, isRenamed, onRenamed }: ItemRowProps) {
  const form = useForm();
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

function Rename({ item, onRenamed, onClose }: Pick<ItemRowProps, "item" | "onRenamed"> & Pick<Props, "onClose">) {
  const [wrong, setWrong] = useState<string | null>(null);
  const rename = (name: string) => {
    try {
      ownLibrary.rename(item, name);
      onRenamed(cleanName(name));
      onClose();
    } catch (error) {
      setWrong(messageOf(error));
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
