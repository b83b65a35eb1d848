/** Opens items and files in the lab, as an edit that can be undone; what came from a file is in the library too. */

import { messageOf } from "../../api/problem";
import { useQueryClient } from "@tanstack/react-query";
import type { Scenario } from "../../api/types";
import { withItem, type Content } from "../../scenario/withItem";
import { sameValue } from "../../scenario/path";
import { useEdit, useLabContext, useReadOnly } from "../../lab/context";
import { useForm } from "../../server/useCatalogues";
import { createAtom } from "@tanstack/react-store";
import { MANUAL } from "../../ui/manual";
import type { Exported, OpenOptions, Unclear } from "./files";
import { requirementsIn } from "../../lab/requirements";
import { dialog, galleryEntry, kindWord } from "../../scenario/library";

export interface Notice {
  readonly lines: readonly string[];
  readonly isWrong: boolean;
  /** It stands until this is no longer the scenario. */
  readonly scenario: Scenario;
}

/** They are asked for one after the other. */
export const unclear = createAtom<readonly Unclear[]>([]);

/** What the library has done last. */
export const notice = createAtom<Notice | null>(null);

/** Says what the library has done, of the scenario there is then. */
export function useSay() {
  const edit = useEdit();
  return (lines: readonly string[], isWrong = false) => notice.set({ lines, isWrong, scenario: edit.newest() });
}

export function useOpenItem(): (item: Content) => void {
  const edit = useEdit();
  const { labAddress } = useLabContext();
  const form = useForm();
  return (item) => {
    if (item.kind === "requirements") labAddress.setView({ requirements: requirementsIn(item.value.requirements) });
    const next = withItem(edit.newest(), item, form);
    if (!sameValue(next, edit.newest())) edit.commit(next);
  };
}

/** Saves an item as a file. */
export function useExportItem(): (item: Exported) => Promise<void> {
  const say = useSay();
  const queries = useQueryClient();
  return async (item) => {
    try {
      const { saveItem } = await import("./upload");
      await saveItem(item, queries);
    } catch (error) {
      dialog.set(null);
      say([`The ${kindWord(item.kind)} “${item.name}” is not exported: ${messageOf(error)}`], true);
    }
  };
}

/** Opens the gallery's scenario that the address named, once; the library keeps what is one's own. */
export function useOpenGalleryEntry(): () => Promise<void> {
  const openFiles = useOpenFiles();
  const say = useSay();
  return async () => {
    const name = galleryEntry.get();
    if (name === null) return;
    galleryEntry.set(null);
    const answer = await fetch(`${MANUAL}gallery/${encodeURIComponent(name)}.json`).catch(() => null);
    if (answer?.ok) await openFiles([new File([await answer.blob()], `${name}.json`)], { inLibrary: false });
    else
      say(
        [
          answer?.status === 404
            ? `The manual’s gallery has no “${name}”`
            : "The gallery’s scenario could not be fetched: open the link again",
        ],
        true,
      );
  };
}

type OpenFiles = (files: readonly File[], options?: OpenOptions) => Promise<string | null>;

/** The promise is what was wrong. */
export function useOpenFiles(): OpenFiles {
  const edit = useEdit();
  const { labAddress } = useLabContext();
  const readOnly = useReadOnly();
  const queries = useQueryClient();
  const say = useSay();
  return async (files, options = {}) => {
    dialog.set(null);
    if (readOnly) {
      say(["A shared result cannot be changed: open a copy to edit first."], true);
      return null;
    }
    say([`Opening ${files.map(({ name }) => name).join(", ")}`]);
    try {
      const { openAll } = await import("./upload");
      const opened = await openAll(files, () => edit.newest(), queries, options);
      const { scenario, requirements, lines, isWrong, asked } = opened;
      if (requirements) labAddress.setView({ requirements });
      if (!sameValue(scenario, edit.newest())) edit.commit(scenario);
      unclear.set([...unclear.get(), ...asked]);
      if (lines.length > 0) say(lines, isWrong);
      else notice.set(null);
      return isWrong ? lines.join(". ") : null;
    } catch (error) {
      say([messageOf(error)], true);
      return messageOf(error);
    }
  };
}
