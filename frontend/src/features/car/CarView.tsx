/** The moving car: one or two strategies on their road, driven by the shared cursor, with playback. */

import { ActionIcon, NativeSelect, Tooltip } from "@mantine/core";
import { useElementSize } from "@mantine/hooks";
import { IconPlayerPauseFilled, IconPlayerPlayFilled } from "../../ui/icons";
import { useEffect, useEffectEvent, useState } from "react";
import type { StrategyId } from "../../api/types";
import { axisUnit } from "../../plots/figure";
import { useCommands } from "../../lab/commands";
import { cursor, useCursor } from "../../lab/cursor";
import type { Scene } from "../../lab/resultView";
import classes from "./car.module.css";
import { Key } from "./Key";
import { Lane } from "./Lane";
import { Options } from "./Options";
import { play } from "./playback";
import { restingCursor } from "./resting";
import { Card } from "../../ui/Card";

const SPEEDS = [
  { value: "0.05", label: "1/20 speed" },
  { value: "0.1", label: "1/10 speed" },
  { value: "0.25", label: "1/4 speed" },
  { value: "1", label: "real time" },
];
/** Heights are drawn this much larger than lengths, or nobody would see them. */
const EXAGGERATIONS = [1, 2, 5, 10].map((factor) => ({ value: String(factor), label: `heights × ${factor}` }));
const NONE = "";

export function CarView({ scene }: { readonly scene: Scene }) {
  const { ref, width } = useElementSize<HTMLDivElement>();
  const [followed, setFollowed] = useState<StrategyId>(NONE);
  const [second, setSecond] = useState<StrategyId>(NONE);
  const [speed, setSpeed] = useState("0.25");
  const [exaggeration, setExaggeration] = useState("5");
  const [playing, setPlaying] = useState(false);

  const first = scene.strategies.find(({ id }) => id === followed) ?? scene.strategies[0];
  const other = scene.strategies.find(({ id }) => id === second && id !== first?.id);
  const names = scene.strategies.map(({ id, label }) => ({ value: id, label }));

  const getScene = useEffectEvent(() => scene);
  const getStrategy = useEffectEvent(() => first?.id ?? "");
  const getSpeed = useEffectEvent(() => Number(speed));
  useEffect(() => {
    if (!playing) return undefined;
    return play(
      () => getScene(),
      () => getStrategy(),
      () => getSpeed(),
    );
  }, [playing]);

  const toggle = () => setPlaying(!playing);
  useCommands([{ group: "Lab", label: playing ? "Pause the car" : "Play the car", keys: "Space", run: toggle }]);

  if (!first) return null;
  return (
    <Card className={classes.view ?? ""} aria-label="The moving car">
      <div ref={ref} className={classes.lanes}>
        {[first, ...(other ? [other] : [])].map((strategy) => (
          <Lane key={strategy.id} scene={scene} strategy={strategy} width={width} exaggeration={Number(exaggeration)} />
        ))}
        {width > 0 && <Key scene={scene} width={width} exaggeration={Number(exaggeration)} />}
      </div>
      <div className={classes.controls}>
        <Tooltip label={playing ? "Pause (Space)" : "Play (Space)"}>
          <ActionIcon variant="light" size={30} aria-label={playing ? "Pause" : "Play"} onClick={toggle}>
            {playing ? <IconPlayerPauseFilled size={15} /> : <IconPlayerPlayFilled size={15} />}
          </ActionIcon>
        </Tooltip>
        <Scrubber scene={scene} />
        <Options>
          <NativeSelect
            size="xs"
            aria-label="Playing speed"
            data={SPEEDS}
            value={speed}
            onChange={(event) => setSpeed(event.currentTarget.value)}
          />
          <NativeSelect
            size="xs"
            aria-label="Exaggeration of heights"
            data={EXAGGERATIONS}
            value={exaggeration}
            onChange={(event) => setExaggeration(event.currentTarget.value)}
          />
          <NativeSelect
            size="xs"
            aria-label="Car shown"
            data={names}
            value={first.id}
            onChange={(event) => setFollowed(event.currentTarget.value)}
          />
          <NativeSelect
            size="xs"
            aria-label="Second car"
            data={[{ value: NONE, label: "no second car" }, ...names.filter(({ value }) => value !== first.id)]}
            value={other?.id ?? NONE}
            onChange={(event) => setSecond(event.currentTarget.value)}
          />
        </Options>
      </div>
    </Card>
  );
}

function Scrubber({ scene }: { readonly scene: Scene }) {
  const [low, high] = scene.range;
  const at = useCursor(scene.axis) ?? restingCursor(scene);
  return (
    <input
      type="range"
      className={classes.scrubber}
      aria-label="Cursor"
      aria-valuetext={`${at.toFixed(2)} ${axisUnit(scene.axis)}`}
      min={low}
      max={high}
      step={(high - low) / 1000}
      value={Math.min(high, Math.max(low, at))}
      onChange={(event) => cursor.set(scene.axis, Number(event.currentTarget.value))}
    />
  );
}
