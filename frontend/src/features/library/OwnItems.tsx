/** One's own items of a kind: opened, renamed, exported and deleted. */

import { Box, Menu } from "@mantine/core";
import { useRef, useState, type ReactNode } from "react";
import { changedFields, changesText, completed } from "../../scenario/differences";
import { cleanName, LONGEST_NAME, ownLibrary, useItems, type Item, type ItemKind } from "../../scenario/library";
import type { Group as Form } from "../../scenario/schema";
import { requirementsIn, requirementsText } from "../../lab/requirements";
import { MoreMenu, NameForm } from "../../ui/ListEntry";
import ui from "../../ui/ui.module.css";
import { formatMinute } from "../../units/dates";
import { count } from "../../units/format";
import { useExportItem } from "./open";

export function Titled({ title, children }: { readonly title: string; readonly children: ReactNode }) {
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

interface ListProps {
  readonly title: string;
  readonly kind: ItemKind;
  readonly form: Form;
  readonly open: (item: Item) => void;
  readonly remove: (item: Item) => void;
}

export function OwnItems({ title, kind, ...row }: ListProps) {
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
