/** Finds an action, a page or a field of the form by its name. */

import { Kbd } from "@mantine/core";
import { createSpotlight, Spotlight, type SpotlightActionData } from "@mantine/spotlight";
import "@mantine/spotlight/styles.layer.css";
import { useEffect, useState } from "react";
import { ACTION_IDS, ACTIONS, canRun, paletteEntries, runAction, type PaletteEntry } from "../lab/actions";
import { keyNames } from "./keys";

const GROUPS = ["Pages", "Lab", "Strategies", "Library", "Presets", "Fields"] as const;
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
    keys: ACTIONS[id].keys?.[0],
    run: () => runAction(id),
  }));

const spotlightAction = (item: Item, index: number, choose: (item: Item) => void): SpotlightActionData => ({
  id: String(index),
  label: item.label,
  ...(item.description !== undefined && { description: item.description }),
  ...(item.keys !== undefined && { rightSection: <Kbd size="xs">{keyNames(item.keys)}</Kbd> }),
  onClick: () => choose(item),
});

/** Every word of the query somewhere in an item's texts; without a query everything but the many fields. */
function matching(all: readonly Item[], query: string): readonly Item[] {
  const words = query.toLowerCase().split(/\s+/).filter(Boolean);
  if (words.length === 0) return all.filter(({ group }) => group !== "Fields");
  const matching = all.filter(({ label, description = "", group }) =>
    words.every((word) => `${label} ${description} ${group}`.toLowerCase().includes(word)),
  );
  const begins = ({ label }: Item) => label.toLowerCase().startsWith(words[0] ?? "");
  return [...matching.filter(begins), ...matching.filter((item) => !begins(item))].slice(0, MOST);
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
      styles={{ actionDescription: { opacity: 1 }, actionSection: { opacity: 1 } }}
      searchProps={{ placeholder: "Command, page or field", "aria-label": "Search commands and fields" }}
    />
  );
}
