/** Finds a command, a page or a field of the form by its name. */

import { Kbd } from "@mantine/core";
import { createSpotlight, Spotlight, type SpotlightActionData } from "@mantine/spotlight";
import "@mantine/spotlight/styles.layer.css";
import { useEffect, useState } from "react";
import { commands, type Command } from "../lab/commands";
import { keyNames } from "./keys";

const GROUPS = ["Pages", "Lab", "Strategies", "Library", "Presets", "Fields"] as const;
const MOST = 40;
const TRANSITION_MS = 100;

const actionOf = (command: Command, index: number, choose: (command: Command) => void): SpotlightActionData => ({
  id: String(index),
  label: command.label,
  ...(command.description !== undefined && { description: command.description }),
  ...(command.keys !== undefined && { rightSection: <Kbd size="xs">{keyNames(command.keys)}</Kbd> }),
  onClick: () => choose(command),
});

/** One that has two keys stands there once. */
const isFirst = (command: Command, index: number, all: readonly Command[]) =>
  all.findIndex(
    ({ group, label, description }) =>
      group === command.group && label === command.label && description === command.description,
  ) === index;

/** Every word of the query somewhere in a command's texts; without a query everything but the many fields. */
function found(all: readonly Command[], query: string): readonly Command[] {
  const words = query.toLowerCase().split(/\s+/).filter(Boolean);
  if (words.length === 0) return all.filter(({ group }) => group !== "Fields");
  const matching = all.filter(({ label, description = "", group }) =>
    words.every((word) => `${label} ${description} ${group}`.toLowerCase().includes(word)),
  );
  const begins = ({ label }: Command) => label.toLowerCase().startsWith(words[0] ?? "");
  return [...matching.filter(begins), ...matching.filter((command) => !begins(command))].slice(0, MOST);
}

export function Palette({ onClose }: { readonly onClose: () => void }) {
  const [all] = useState(() => commands().filter(isFirst));
  const [query, setQuery] = useState("");
  const [[store, { open }]] = useState(createSpotlight);
  const [chosen, setChosen] = useState<Command | null>(null);
  const [focused] = useState(() => document.activeElement);
  useEffect(open, [open]);
  const shown = found(all, query);
  const actions = GROUPS.map((group) => ({
    group,
    actions: shown
      .filter((command) => command.group === group)
      .map((command) => actionOf(command, all.indexOf(command), setChosen)),
  }));
  return (
    <Spotlight
      store={store}
      shortcut={null}
      actions={actions.filter((group) => group.actions.length > 0)}
      filter={(_, given) => given}
      query={query}
      onQueryChange={setQuery}
      returnFocus={false}
      transitionProps={{
        transition: "pop",
        duration: TRANSITION_MS,
        onExited: () => {
          onClose();
          // A command may move it on.
          if (focused instanceof HTMLElement) focused.focus({ preventScroll: true });
          chosen?.run();
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
