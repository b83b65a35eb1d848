/** What the lab puts into the header: presets, undo and redo, what the last answer cost, sweep, share and export. */

import { Button, Menu, Text } from "@mantine/core";
import { IconArrowBackUp, IconArrowForwardUp, IconTemplate } from "../icons";
import type { Preset } from "../api/types";
import { useDesk, useLab, useReadOnly } from "../state/context";
import { ExportMenu } from "../export/ExportMenu";
import { ShareRun } from "../share/ShareRun";
import { SweepButton } from "../sweep/SweepButton";
import { IconButton } from "./IconButton";
import classes from "./shell.module.css";
import { StatusLine } from "./StatusLine";
import { compact } from "../ui/compact";

export function LabTools({ presets }: { readonly presets: readonly Preset[] }) {
  const { lab } = useDesk();
  const readOnly = useReadOnly();
  const canUndo = useLab((state) => state.shared === null && (state.history?.past.length ?? 0) > 0);
  const canRedo = useLab((state) => state.shared === null && (state.history?.future.length ?? 0) > 0);
  return (
    <>
      <PresetMenu presets={presets} disabled={readOnly} />
      <IconButton label="Undo" disabled={!canUndo} onClick={lab.undo}>
        <IconArrowBackUp size={18} stroke={1.7} />
      </IconButton>
      <IconButton label="Redo" disabled={!canRedo} onClick={lab.redo}>
        <IconArrowForwardUp size={18} stroke={1.7} />
      </IconButton>
      <StatusLine place="header" />
      <span className={classes.grow} />
      <SweepButton />
      <ShareRun />
      <ExportMenu />
    </>
  );
}

function PresetMenu({ presets, disabled }: { readonly presets: readonly Preset[]; readonly disabled: boolean }) {
  const { lab } = useDesk();
  return (
    <Menu position="bottom-start" width={320} withinPortal>
      <Menu.Target>
        <Button
          size="xs"
          variant="default"
          aria-label="Presets"
          leftSection={<IconTemplate size={16} stroke={1.7} />}
          classNames={compact}
          disabled={disabled || presets.length === 0}
        >
          Presets
        </Button>
      </Menu.Target>
      <Menu.Dropdown>
        {presets.map((preset) => (
          <Menu.Item key={preset.id} onClick={() => lab.commit(preset.scenario)}>
            <Text size="sm" fw={600}>
              {preset.label}
            </Text>
            <Text size="xs" c="dimmed">
              {preset.description}
            </Text>
          </Menu.Item>
        ))}
      </Menu.Dropdown>
    </Menu>
  );
}
