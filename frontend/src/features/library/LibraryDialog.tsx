/** One's own scenarios, vehicles and roads, and the presets: saved, opened, renamed, deleted, imported and exported. */

import { Box, Button, Modal, Text } from "@mantine/core";
import { useState } from "react";
import type { Preset } from "../../api/types";
import type { Group } from "../../scenario/schema";
import { ItemRow } from "./ItemRow";
import type { Item, Kind } from "../../scenario/library";
import classes from "./library.module.css";
import { useOpenItem } from "./open";
import { OpenFiles } from "./OpenFiles";
import { ownLibrary, useItems } from "../../scenario/ownLibrary";
import { SaveForm } from "./SaveForm";

interface Props {
  readonly form: Group;
  readonly presets: readonly Preset[];
  readonly saving: Exclude<Kind, "road">;
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
    <Modal opened onClose={onClose} title="Library" size="lg" closeButtonProps={{ "aria-label": "Close" }}>
      <SaveForm form={form} kind={saving} onSaved={onClose} />
      <div className={classes.import}>
        <OpenFiles name="Files for the library" size="xs">
          Import files
        </OpenFiles>
        <Text className={classes.text}>
          Scenarios and vehicles as JSON, measured roads as CSV; or drop them anywhere on the lab. This browser keeps
          the library: export what others need.
        </Text>
      </div>
      {deleted && (
        <div className={classes.deleted}>
          <Text size="sm" role="status">
            Deleted the {deleted.kind} “{deleted.name}”.
          </Text>
          <Button size="compact-xs" variant="default" autoFocus onClick={() => restore(deleted)}>
            Undo
          </Button>
        </div>
      )}
      <OwnItems title="Your scenarios" kind="scenario" {...{ form, open, remove }} />
      <OwnItems title="Your vehicles" kind="vehicle" {...{ form, open, remove }} />
      <OwnItems title="Your measured roads" kind="road" {...{ form, open, remove }} />
      <Box component="h3" m="1rem 0 0.3rem" fz="sm" fw={650}>
        Presets
      </Box>
      <ul className={classes.list} aria-label="Presets">
        {presets.map(({ id, label, description, scenario }) => (
          <li key={id} className={classes.entry}>
            <button type="button" className={classes.open} onClick={() => open({ kind: "scenario", value: scenario })}>
              <span className={classes.name}>{label}</span>
              <span className={classes.text}>{description}</span>
            </button>
          </li>
        ))}
      </ul>
    </Modal>
  );
}

interface ListProps {
  readonly title: string;
  readonly kind: Kind;
  readonly form: Group;
  readonly open: (item: Item) => void;
  readonly remove: (item: Item) => void;
}

function OwnItems({ title, kind, ...row }: ListProps) {
  const items = useItems(kind);
  const [renamed, setRenamed] = useState<string | null>(null);
  if (items.length === 0) return null;
  return (
    <>
      <Box component="h3" m="1rem 0 0.3rem" fz="sm" fw={650}>
        {title}
      </Box>
      <ul className={classes.list} aria-label={title}>
        {items.map((item) => (
          <ItemRow key={item.name} item={item} isRenamed={item.name === renamed} onRenamed={setRenamed} {...row} />
        ))}
      </ul>
    </>
  );
}
