/** Opens the library; what is in it is found by name. */

import { Button } from "@mantine/core";
import { lazy } from "react";
import { Icon } from "../../ui/icons";
import { useAction, useActionButton, usePaletteEntries } from "../../lab/actions";
import { useReadOnly } from "../../lab/context";
import { vehiclesQuery } from "../../server/queries";
import { useQuery } from "@tanstack/react-query";
import { useSelector } from "@tanstack/react-store";
import { LazyPart } from "../../ui/LazyPart";
import { useOpenItem } from "./open";
import { dialog, kindWord, ownLibrary } from "../../scenario/library";
import { compact } from "../../ui/IconButton";

const LibraryDialog = lazy(() => import("./LibraryDialog").then((module) => ({ default: module.LibraryDialog })));

const close = () => dialog.set(null);

export function LibraryButton() {
  const readOnly = useReadOnly();
  const saving = useSelector(dialog);
  const items = useSelector(ownLibrary);
  const open = useOpenItem();
  const canEdit = !readOnly;
  useAction("library", canEdit ? () => dialog.set("scenario") : null);
  useAction("saveVehicle", canEdit ? () => dialog.set("vehicle") : null);
  const { data: vehicles = [] } = useQuery(vehiclesQuery);
  const found = [
    ...vehicles.map(({ label, vehicle }) => ({
      label,
      description: "Vehicle",
      kind: "vehicle" as const,
      value: vehicle,
    })),
    ...items.map((item) => ({ label: item.name, description: `Own ${kindWord(item.kind)}`, ...item })),
  ].map(({ label, description, ...item }) => ({
    group: "Library" as const,
    label,
    description,
    run: () => open(item),
  }));
  usePaletteEntries(canEdit ? found : []);
  const { label, ...button } = useActionButton("library");
  return (
    <>
      <Button
        aria-label={label}
        leftSection={<Icon name="Template" size={16} stroke={1.7} />}
        classNames={compact}
        {...button}
      >
        {label}
      </Button>
      {saving && canEdit && (
        <LazyPart onClose={close}>
          <LibraryDialog saving={saving} onClose={close} />
        </LazyPart>
      )}
    </>
  );
}
