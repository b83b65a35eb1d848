/** What the page of a sweep can do: share it and save its runs as files. */

import { Button, Menu } from "@mantine/core";
import { IconBraces, IconDownload, IconFileTypeCsv, IconTable } from "../../ui/icons";
import { address, ask } from "../../api/http";
import type { Batch, SharedView } from "../../api/types";
import { download } from "../../lib/download";
import { ShareLink } from "../../features/share/ShareLink";
import type { BatchView } from "./view";
import { compact } from "../../ui/compact";

interface Props {
  readonly batch: Batch | undefined;
  readonly view: BatchView;
}

const FORMATS = [
  { format: "csv", label: "CSV", icon: IconFileTypeCsv },
  { format: "parquet", label: "Parquet", icon: IconTable },
  { format: "json", label: "JSON", icon: IconBraces },
] as const;

export function BatchActions({ batch, view }: Props) {
  return (
    <>
      <ShareLink
        make={() =>
          batch
            ? ask("post", "/links", { body: { batch_id: batch.id, view: toShare(batch, view) } })
            : Promise.reject(new Error("there is no sweep"))
        }
        obstacle={batch ? null : "There is no sweep to share yet"}
        opens="It opens this sweep with its plot as it is here, for anyone who has the link. It is read-only."
      />
      <Menu position="bottom-end" width={260}>
        <Menu.Target>
          <Button
            size="xs"
            variant="default"
            aria-label="Export"
            classNames={compact}
            leftSection={<IconDownload size={15} />}
            disabled={!batch}
          >
            Export
          </Button>
        </Menu.Target>
        <Menu.Dropdown>
          <Menu.Label>One row per run, all metrics</Menu.Label>
          {FORMATS.map(({ format, label, icon: Icon }) => (
            <Menu.Item
              key={format}
              leftSection={<Icon size={16} />}
              onClick={() =>
                batch &&
                download(
                  address("/batches/{id}/results", { path: { id: batch.id }, query: { format } }),
                  `ridelab-batch-${batch.id}.${format}`,
                )
              }
            >
              {label}
            </Menu.Item>
          ))}
        </Menu.Dropdown>
      </Menu>
    </>
  );
}

/** How it is looked at, without what the page itself chooses. */
function toShare({ fields, strategies }: Batch, { x, hidden, ...view }: BatchView): SharedView {
  const shown = {
    ...view,
    x: x ?? fields[0]?.name ?? null,
    hidden: hidden.filter((id) => strategies.some((each) => each === id)),
  };
  return Object.fromEntries(Object.entries(shown).filter(([, value]) => value !== null));
}
