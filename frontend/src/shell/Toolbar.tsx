/** Which strategies are shown, over what, and which part of the run. */

import { Button, SegmentedControl, Tooltip } from "@mantine/core";
import { IconZoomReset } from "../icons";
import { memo } from "react";
import type { Strategy } from "../api/types";
import { switchAxis } from "../state/axis";
import { useDesk, useLab, useView } from "../state/context";
import type { Scene } from "../state/scene";
import { StrategyKey } from "../tables/StrategyKey";
import { bumpRange } from "./bumpRange";
import { RoadsSelect } from "./RoadsSelect";
import classes from "./shell.module.css";
import bar from "./toolbar.module.css";

interface Props {
  readonly strategies: readonly Strategy[];
  readonly scene: Scene | null;
}

const StrategyChips = memo(function StrategyChips({ strategies }: { readonly strategies: readonly Strategy[] }) {
  const { lab } = useDesk();
  const selected = useLab((state) => state.strategies);
  // A shared result has what it has: other strategies would be a new run.
  const summaries = useLab((state) => (state.shared ? state.shown?.summaries : undefined));
  const toggle = (id: string) =>
    lab.setStrategies(strategies.map((strategy) => strategy.id).filter((other) => selected.includes(other) !== (other === id)));
  return (
    <div className={bar.chips} role="group" aria-label="Strategies">
      {strategies.map((strategy) => (
        <Tooltip key={strategy.id} label={strategy.description} multiline w={240} openDelay={500}>
          <button
            type="button"
            className={bar.chip}
            disabled={summaries !== undefined && !(strategy.id in summaries)}
            aria-pressed={selected.includes(strategy.id)}
            onClick={() => toggle(strategy.id)}
          >
            <StrategyKey strategy={strategy} />
            {strategy.label}
          </button>
        </Tooltip>
      ))}
    </div>
  );
});

export function Toolbar({ strategies, scene }: Props) {
  const { router } = useDesk();
  const view = useView();
  const bump = scene && bumpRange(scene);
  return (
    <div className={bar.toolbar}>
      <StrategyChips strategies={strategies} />
      <span className={classes.grow} />
      <div className={bar.tools}>
        <RoadsSelect />
        <SegmentedControl
          size="xs"
          aria-label="Plots over"
          value={view.axis}
          data={[
            { value: "distance", label: "Distance" },
            { value: "time", label: "Time" },
          ]}
          onChange={(axis) => switchAxis(router, scene, axis)}
        />
        <Button size="xs" variant="default" disabled={!bump} onClick={() => router.setView({ zoom: bump })}>
          Bump
        </Button>
        <Tooltip label="Show the whole run (or double click a plot)">
          <Button size="xs" variant="default" leftSection={<IconZoomReset size={15} />} disabled={view.zoom === null} onClick={() => router.setView({ zoom: null })}>
            All
          </Button>
        </Tooltip>
      </div>
    </div>
  );
}
