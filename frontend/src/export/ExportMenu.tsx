/** Data, pictures and a command line of what is shown. */

import { Button, Menu } from "@mantine/core";
import { IconCheck, IconDownload, IconFileTypeCsv, IconPhoto, IconTerminal2 } from "@tabler/icons-react";
import { useQuery } from "@tanstack/react-query";
import { api } from "../api/client";
import { useDesk, useLab, useView } from "../state/context";
import { figuresQuery, strategiesQuery } from "../state/queries";
import { makeScene } from "../state/scene";
import shell from "../shell/shell.module.css";
import { curlCommand } from "./curl";
import { download, plotsImage } from "./image";
import { useCopied } from "./useCopied";

export function ExportMenu() {
  const shown = useLab((state) => state.shown);
  const chosen = useLab((state) => state.strategies);
  const view = useView();
  const { lab } = useDesk();
  const figures = useQuery(figuresQuery).data;
  const strategies = useQuery(strategiesQuery).data;
  const { copied, copy } = useCopied();
  const runId = shown?.runId ?? null;

  const saveImage = (format: "png" | "svg") => {
    if (!shown || !figures || !strategies) return;
    const scene = makeScene(shown, strategies, chosen, view);
    void plotsImage(figures, scene, format).then((address) => download(address, `ridelab-${runId ?? "live"}.${format}`));
  };

  return (
    <Menu position="bottom-end" width={270}>
      <Menu.Target>
        <Button
          size="xs"
          variant="default"
          aria-label="Export"
          leftSection={copied ? <IconCheck size={15} /> : <IconDownload size={15} />}
          classNames={{ root: shell.compact ?? "", label: shell.compactLabel ?? "", section: shell.compactSection ?? "" }}
          disabled={!shown}
        >
          {copied ? "Copied" : "Export"}
        </Button>
      </Menu.Target>
      <Menu.Dropdown>
        <Menu.Label>Time histories, full resolution</Menu.Label>
        {(strategies ?? [])
          .filter(({ id }) => shown && id in shown.summaries && chosen.includes(id))
          .map(({ id, label }) => (
            <Menu.Item
              key={id}
              leftSection={<IconFileTypeCsv size={16} />}
              disabled={runId === null}
              onClick={() => download(api.seriesAddress(runId ?? "", id, "csv"), `ridelab-${runId ?? ""}-${id}.csv`)}
            >
              {label} as CSV
            </Menu.Item>
          ))}
        <Menu.Label>Plots as shown</Menu.Label>
        <Menu.Item leftSection={<IconPhoto size={16} />} onClick={() => saveImage("png")}>
          PNG picture
        </Menu.Item>
        <Menu.Item leftSection={<IconPhoto size={16} />} onClick={() => saveImage("svg")}>
          SVG drawing
        </Menu.Item>
        <Menu.Label>Scenario</Menu.Label>
        <Menu.Item
          leftSection={<IconTerminal2 size={16} />}
          onClick={() => copy(curlCommand(window.location.origin, lab.get().history?.present ?? shown?.scenario ?? {}, chosen))}
        >
          Copy as curl
        </Menu.Item>
      </Menu.Dropdown>
    </Menu>
  );
}
