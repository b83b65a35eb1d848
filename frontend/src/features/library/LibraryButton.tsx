/** Opens the library; its commands by name and by key. */

import { Button } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { lazy } from "react";
import type { Preset } from "../../api/types";
import { IconTemplate } from "../../ui/icons";
import { useCommands, type Command } from "../../lab/commands";
import { useReadOnly } from "../../lab/context";
import { schemaQuery } from "../../server/queries";
import { useStore } from "../../lib/store";
import { compact } from "../../ui/compact";
import { LazyPart } from "../../ui/LazyPart";
import { useOpenItem } from "./open";
import { dialog, ownLibrary } from "../../scenario/library";

const LibraryDialog = lazy(() => import("./LibraryDialog").then((module) => ({ default: module.LibraryDialog })));

const close = () => dialog.set(null);

export function LibraryButton({ presets }: { readonly presets: readonly Preset[] }) {
  const form = useQuery(schemaQuery).data;
  const readOnly = useReadOnly();
  const saving = useStore(dialog);
  const items = useStore(ownLibrary);
  const open = useOpenItem();
  const own: readonly Command[] = [
    { group: "Lab", label: "Library: save, open, import and export", keys: "mod+S", run: () => dialog.set("scenario") },
    { group: "Lab", label: "Save the vehicle in the library", run: () => dialog.set("vehicle") },
    ...items.map((item): Command => ({
      group: "Library",
      label: item.name,
      description: `Own ${item.kind}`,
      run: () => open(item),
    })),
  ];
  useCommands(form && !readOnly ? own : []);
  return (
    <>
      <Button
        size="xs"
        variant="default"
        aria-label="Library"
        leftSection={<IconTemplate size={16} stroke={1.7} />}
        classNames={compact}
        disabled={readOnly || !form}
        onClick={() => dialog.set("scenario")}
      >
        Library
      </Button>
      {saving && form && !readOnly && (
        <LazyPart onClose={close}>
          <LibraryDialog {...{ form, presets, saving }} onClose={close} />
        </LazyPart>
      )}
    </>
  );
}
