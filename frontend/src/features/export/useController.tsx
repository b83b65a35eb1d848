/** Fetches the controller's C sources and hands them to the browser as a file. */

import { Modal, Text } from "@mantine/core";
import { useMutation } from "@tanstack/react-query";
import { askFile } from "../../api/http";
import type { Scenario } from "../../api/types";
import { download } from "../../lib/download";

/** Long enough for the browser to have taken the file [ms]. */
const KEEP_MS = 60_000;

/** A file from memory. */
export function saveAs(blob: Blob, name: string): void {
  const address = URL.createObjectURL(blob);
  download(address, name);
  setTimeout(() => URL.revokeObjectURL(address), KEEP_MS);
}

export function useController() {
  const { mutate, isPending, error, reset } = useMutation({
    mutationFn: (scenario: Scenario) =>
      askFile("post", "/controller", { body: { scenario } }, (response) => response.blob()),
    onSuccess: (zip) => saveAs(zip, "ridelab-controller.zip"),
  });
  return { save: mutate, saving: isPending, error, reset };
}

/** Says why there is no file. */
export function ControllerFault({ error, reset }: Pick<ReturnType<typeof useController>, "error" | "reset">) {
  return (
    <Modal opened={error !== null} onClose={reset} title="The controller could not be exported">
      <Text>{error?.message}</Text>
    </Modal>
  );
}
