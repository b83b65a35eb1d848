/** What a page beside the lab can be saved as: a menu of files. */

import { Button, Menu, Modal, Text } from "@mantine/core";
import type { ReactNode } from "react";
import { usePaletteEntries, type PaletteEntry } from "../../lab/actions";
import { download } from "../../lib/download";
import { Icon } from "../../ui/icons";
import { address, askFile } from "../../api/http";
import { explain } from "../../api/problem";
import type { Batch, Scenario } from "../../api/types";
import { compact } from "../../ui/IconButton";
import { useMutation } from "@tanstack/react-query";

export interface SavedFile {
  readonly label: string;
  readonly icon: ReactNode;
  readonly save: () => void;
}

interface Props {
  /** What the files have, such as one row per run. */
  readonly contents: string;
  /** None until there is something to save. */
  readonly files: readonly SavedFile[];
  readonly saving?: boolean;
}

export function FileMenu({ contents, files, saving = false }: Props) {
  usePaletteEntries(
    files.map(({ label, save }): PaletteEntry => ({
      group: "Files",
      label: `Export: ${label}`,
      description: contents,
      run: save,
    })),
  );
  return (
    <SaveMenu disabled={files.length === 0} loading={saving}>
      <Menu.Label>{contents}</Menu.Label>
      {files.map(({ label, icon, save }) => (
        <Menu.Item key={label} leftSection={icon} onClick={save}>
          {label}
        </Menu.Item>
      ))}
    </SaveMenu>
  );
}

interface SaveMenuProps {
  readonly disabled: boolean;
  readonly loading: boolean;
  /** For a moment. */
  readonly copied?: boolean;
  readonly children: ReactNode;
}

export const SaveMenu = ({ disabled, loading, copied = false, children }: SaveMenuProps) => (
  <Menu position="bottom-end" width={290}>
    <Menu.Target>
      <Button
        aria-label="Export"
        classNames={compact}
        leftSection={<Icon name={copied ? "Check" : "Download"} size={15} />}
        {...{ disabled, loading }}
      >
        {copied ? "Copied" : "Export"}
      </Button>
    </Menu.Target>
    <Menu.Dropdown mah="calc(100vh - 5rem)" style={{ overflowY: "auto" }}>
      {children}
    </Menu.Dropdown>
  </Menu>
);

const FORMATS = [
  { format: "csv", label: "CSV", icon: <Icon name="FileTypeCsv" size={16} /> },
  { format: "json", label: "JSON", icon: <Icon name="Braces" size={16} /> },
] as const;

/** A sweep's or a study's runs. */
export function BatchFiles({ batch: { id } }: { readonly batch: Batch }) {
  const files = FORMATS.map(({ format, ...shown }) => ({
    ...shown,
    save: () =>
      download(address("/batches/{id}/results", { path: { id }, query: { format } }), `ridelab-batch-${id}.${format}`),
  }));
  return <FileMenu contents="One row per run, all metrics" files={files} />;
}

/** The C sources of a scenario's controller. */
export function ControllerFile({ scenario }: { readonly scenario: Scenario | undefined }) {
  const { save, saving, fault } = useController();
  const file = scenario && {
    label: "Controller (C), a zip",
    icon: <Icon name="Cpu" size={16} />,
    save: () => save(scenario),
  };
  return (
    <>
      <FileMenu
        contents="This scenario’s tables, the C99 program without dynamic memory, a Makefile"
        files={file ? [file] : []}
        saving={saving}
      />
      {fault}
    </>
  );
}

/** Long enough for the browser to have taken the file [ms]. */
const KEEP_MS = 60_000;

/** A file from memory. */
export function saveAs(blob: Blob, name: string): void {
  const address = URL.createObjectURL(blob);
  download(address, name);
  setTimeout(() => URL.revokeObjectURL(address), KEEP_MS);
}

/** Fetches the controller's C sources and hands them to the browser as a file. */
export function useController() {
  const { mutate, isPending, error, reset } = useMutation({
    mutationFn: (scenario: Scenario) =>
      askFile("post", "/controller", { body: { scenario } }, (response) => response.blob()),
    onSuccess: (zip) => saveAs(zip, "ridelab-controller.zip"),
  });
  const fault = <FileFault title="The controller could not be exported" {...{ error, reset }} />;
  return { save: mutate, saving: isPending, fault };
}

interface FileFaultProps {
  readonly title: string;
  readonly error: Error | null;
  readonly reset: () => void;
}

/** Says why there is no file. */
export const FileFault = ({ title, error, reset }: FileFaultProps) => (
  <Modal opened={error !== null} onClose={reset} {...{ title }}>
    <Text>{error && explain(error)}</Text>
  </Modal>
);
