/** One item of the library: opened by a click; renamed, exported and deleted by its menu. */

import { Menu } from "@mantine/core";
import { useRef, useState } from "react";
import { requirementsIn, requirementsText } from "../../lab/requirements";
import { changedFields, changesText, completed } from "../../scenario/differences";
import type { Group } from "../../scenario/schema";
import { LONGEST_NAME, cleanName, type Item, ownLibrary } from "../../scenario/library";
import { MoreMenu, NameForm } from "../../ui/NameForm";
import { formatMinute } from "../../units/dates";
import { count } from "../../units/format";
import ui from "../../ui/ui.module.css";
import { useExportItem } from "./open";

interface Props {
  readonly item: Item;
  readonly form: Group;
  readonly open: (item: Item) => void;
  readonly remove: (item: Item) => void;
  /** It has just got its name: the focus is on its menu, as it was before. */
  readonly isRenamed: boolean;
  readonly onRenamed: (name: string) => void;
}

/** A scenario and a vehicle by what differs from the paper's. */
function describe({ kind, value }: Item, form: Group): string {
  if (kind === "road") {
    const bumps = Array.isArray(value.bumps) ? value.bumps.length : 0;
    return `${typeof value.length === "number" ? value.length : "?"} m, ${count(bumps, "bump")} in it`;
  }
  if (kind === "requirements") return requirementsText(requirementsIn(value.requirements)).replaceAll(";", "; ");
  const paper = completed(form, {});
  const scenario = kind === "scenario" ? value : { ...paper, vehicle: value };
  return changesText(changedFields(form, paper, completed(form, scenario))) || "As in the paper";
}

export function ItemRow({ item, form, open, remove, isRenamed, onRenamed }: Props) {
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

interface RenameProps extends Pick<Props, "item" | "onRenamed"> {
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
