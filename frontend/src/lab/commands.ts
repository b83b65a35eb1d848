/** What can be done by name or by key: the part of the page that does it says so while it is shown. */

import { useEffect, useRef } from "react";

export interface Command {
  readonly group: "Pages" | "Lab" | "Strategies" | "Library" | "Presets" | "Fields";
  readonly label: string;
  readonly description?: string;
  /** `mod+Z`, `Space`; `mod` is Ctrl, on a Mac the command key. */
  readonly keys?: string;
  readonly run: () => void;
}

interface Entry {
  readonly current: readonly Command[];
}

const entries = new Set<Entry>();

export const commands = (): readonly Command[] => [...entries].flatMap(({ current }) => current);

export function useCommands(own: readonly Command[]): void {
  const entry = useRef(own);
  useEffect(() => {
    entry.current = own;
  });
  useEffect(() => {
    entries.add(entry);
    return () => void entries.delete(entry);
  }, []);
}
