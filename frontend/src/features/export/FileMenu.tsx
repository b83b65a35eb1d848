/** What a page beside the lab can be saved as: a menu of files at addresses of the server. */

import { Button, Menu } from "@mantine/core";
import type { ReactNode } from "react";
import { download } from "../../lib/download";
import { compact } from "../../ui/compact";
import { IconBraces, IconDownload, IconFileTypeCsv, IconTable } from "../../ui/icons";
import { address } from "../../api/http";
import type { Batch } from "../../api/types";

export interface SavedFile {
  readonly label: string;
  readonly icon: ReactNode;
  readonly address: string;
  readonly name: string;
}

interface Props {
  /** What the files have, such as one row per run. */
  readonly contents: string;
  /** None until there is something to save. */
  readonly files: readonly SavedFile[];
}

export function FileMenu({ contents, files }: Props) {
  return (
    <Menu position="bottom-end" width={260}>
      <Menu.Target>
        <Button
          aria-label="Export"
          classNames={compact}
          leftSection={<IconDownload size={15} />}
          disabled={files.length === 0}
        >
          Export
        </Button>
      </Menu.Target>
      <Menu.Dropdown>
        <Menu.Label>{contents}</Menu.Label>
        {files.map(({ label, icon, address, name }) => (
          <Menu.Item key={label} leftSection={icon} onClick={() => download(address, name)}>
            {label}
          </Menu.Item>
        ))}
      </Menu.Dropdown>
    </Menu>
  );
}

const FORMATS = [
  { format: "csv", label: "CSV", icon: <IconFileTypeCsv size={16} /> },
  { format: "parquet", label: "Parquet", icon: <IconTable size={16} /> },
  { format: "json", label: "JSON", icon: <IconBraces size={16} /> },
] as const;

/** A sweep's or a study's runs. */
export function BatchFiles({ batch }: { readonly batch: Batch | undefined }) {
  const filesOf = ({ id }: Batch) =>
    FORMATS.map(({ format, ...shown }) => ({
      ...shown,
      address: address("/batches/{id}/results", { path: { id }, query: { format } }),
      name: `ridelab-batch-${id}.${format}`,
    }));
  return <FileMenu contents="One row per run, all metrics" files={batch ? filesOf(batch) : []} />;
}
