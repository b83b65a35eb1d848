/** What is opened by a key: the search for an action, a page or a field by its name; and help. */

import { Kbd, Button, Group, Modal, Switch } from "@mantine/core";
import { createSpotlight, Spotlight, type SpotlightActionData } from "@mantine/spotlight";
import "@mantine/spotlight/styles.layer.css";
import { useSelector } from "@tanstack/react-store";
import { useEffect, useState } from "react";
import {
  ACTION_IDS,
  ACTIONS,
  canRun,
  paletteEntries,
  runAction,
  type PaletteEntry,
  isKeyOn,
  isOffered,
  letterKeys,
  useActionButton,
} from "../lab/actions";
import { hasWords, wordsOf } from "../lib/search";
import { DataTable } from "../ui/DataTable";
import { Icon } from "../ui/icons";
import { MANUAL } from "../ui/manual";

const GROUPS = ["Pages", "Lab", "Files", "Strategies", "Library", "Presets", "Fields"] as const;
const MOST = 40;
const TRANSITION_MS = 100;

interface Item extends Omit<PaletteEntry, "group"> {
  readonly group: (typeof GROUPS)[number];
  readonly keys?: string | undefined;
}

const runnable = (): readonly Item[] =>
  ACTION_IDS.filter(canRun).map((id) => ({
    group: "Lab",
    label: ACTIONS[id].label,
    searchWords: ACTIONS[id].searchWords,
    keys: ACTIONS[id].keys?.find(isKeyOn),
    run: () => runAction(id),
  }));

const spotlightAction = (item: Item, index: number, choose: (item: Item) => void): SpotlightActionData => ({
  id: String(index),
  label: item.label,
  ...(item.description !== undefined && { description: item.description }),
  ...(item.keys !== undefined && { rightSection: <Kbd size="xs">{keyNames(item.keys)}</Kbd> }),
  onClick: () => choose(item),
});

/** Every word of the query somewhere in an item's texts, those in its name first; without a query everything but the many fields. */
function matching(all: readonly Item[], query: string): readonly Item[] {
  const words = wordsOf(query);
  if (words.length === 0) return all.filter(({ group }) => group !== "Fields");
  const begins = ({ label }: Item) => label.toLowerCase().startsWith(words[0] ?? "");
  const isNamed = (item: Item) => hasWords(item.label, words);
  const rank = (item: Item) => (begins(item) ? 0 : isNamed(item) ? 1 : 2);
  return all
    .filter(({ label, description = "", group, searchWords }) =>
      hasWords(`${label} ${description} ${group}`, words, searchWords),
    )
    .sort((one, other) => rank(one) - rank(other))
    .slice(0, MOST);
}

export function Palette({ onClose }: { readonly onClose: () => void }) {
  const [all] = useState<readonly Item[]>(() => [...runnable(), ...paletteEntries()]);
  const [query, setQuery] = useState("");
  const [[store, { open }]] = useState(createSpotlight);
  const [picked, setPicked] = useState<Item | null>(null);
  const [focused] = useState(() => document.activeElement);
  useEffect(open, [open]);
  const shown = matching(all, query);
  const actions = GROUPS.map((group) => ({
    group,
    actions: shown
      .filter((item) => item.group === group)
      .map((item) => spotlightAction(item, all.indexOf(item), setPicked)),
  }));
  return (
    <Spotlight
      store={store}
      shortcut={null}
      actions={actions.filter((group) => group.actions.length > 0)}
      filter={(_, items) => items}
      query={query}
      onQueryChange={setQuery}
      returnFocus={false}
      transitionProps={{
        transition: "pop",
        duration: TRANSITION_MS,
        onExited: () => {
          onClose();
          // An action may move it on.
          if (focused instanceof HTMLElement) focused.focus({ preventScroll: true });
          picked?.run();
        },
      }}
      nothingFound="Nothing of that name"
      scrollable
      maxHeight={420}
      overlayProps={{ blur: 0, backgroundOpacity: 0.25 }}
      attributes={{ content: { "aria-label": "Commands and fields" } }}
      styles={{ actionDescription: { opacity: 1 }, actionSection: { opacity: 1 } }}
      searchProps={{ placeholder: "Command, page or field", "aria-label": "Search commands and fields" }}
    />
  );
}

const EVERYWHERE = [
  { label: "Slider or plot cursor: one step back or forward", keys: "← →" },
  { label: "Apply a typed value", keys: "Enter" },
  { label: "Discard a typed value, close a window", keys: "Esc" },
];

/** Where one learns more: the tour, the manual, and which keys there are on this page. */
export function Help({ onClose }: { readonly onClose: () => void }) {
  const tour = useActionButton("tour");
  const letters = useSelector(letterKeys);
  const named = ACTION_IDS.filter(isOffered).flatMap((id) => {
    const { label, keys = [] } = ACTIONS[id];
    const on = keys.filter(isKeyOn);
    return on.length > 0 ? [{ label, keys: on.map(keyNames).join(" or ") }] : [];
  });
  return (
    <Modal opened onClose={onClose} title="Help">
      <Group gap="0.5rem" mb="0.7rem">
        {isOffered("tour") && (
          <Button
            variant="light"
            onClick={() => {
              onClose();
              tour.onClick();
            }}
          >
            {tour.label}
          </Button>
        )}
        <Button component="a" href={MANUAL} target="_blank" rightSection={<Icon name="ExternalLink" size={14} />}>
          Read the manual
        </Button>
      </Group>
      <Switch
        size="xs"
        mb="0.5rem"
        label="Keys of one letter"
        checked={letters}
        onChange={({ currentTarget: { checked } }) => letterKeys.set(checked)}
      />
      <DataTable
        label="Keys"
        rows={[...named, ...EVERYWHERE]}
        rowKey={({ keys, label }) => keys + label}
        columns={[
          { key: "keys", head: "Key", text: true, cell: ({ keys }) => <Kbd>{keys}</Kbd> },
          { key: "label", head: "What it does", text: true, cell: ({ label }) => label },
        ]}
      />
    </Modal>
  );
}

/** Keys as they are written on this machine's keyboard. */
const keyNames = (keys: string): string => {
  const mod = /Mac|iPhone|iPad/.test(navigator.userAgent) ? "⌘" : "Ctrl";
  return keys.replace("mod", mod).replace("shift", "Shift").replace(/\+/g, " + ");
};
