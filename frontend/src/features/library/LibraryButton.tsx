/** Opens the library; what is in it is found by name. */

import { Button } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { lazy } from "react";
import type { Preset } from "../../api/types";
import { IconTemplate } from "../../ui/icons";
import { useAction, useActionButton, usePaletteEntries } from "../../lab/actions";
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
  const canEdit = form !== undefined && !readOnly;
  useAction("library", canEdit ? () => dialog.set("scenario") : null);
  useAction("saveVehicle", canEdit ? () => dialog.set("vehicle") : null);
  const found = items.map(
    (item) => ({ group: "Library", label: item.name, description: `Own ${item.kind}`, run: () => open(item) }) as const,
  );
  usePaletteEntries(canEdit ? found : []);
  const { label, ...button } = useActionButton("library");
  return (
    <>
      <Button
        size="xs"
        variant="default"
        aria-label={label}
        leftSection={<IconTemplate size={16} stroke={1.7} />}
        classNames={compact}
        {...button}
      >
        {label}
      </Button>
      {saving && form && !readOnly && (
        <LazyPart onClose={close}>
          <LibraryDialog {...{ form, presets, saving }} onClose={close} />
        </LazyPart>
      )}
    </>
  );
}
