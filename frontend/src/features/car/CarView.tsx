/** The moving car: one or two strategies on their road, driven by the shared cursor, with playback. */

import { ActionIcon, Button, Group, Popover, Stack } from "@mantine/core";
import { useElementSize, useMediaQuery } from "@mantine/hooks";
import { useEffect, useEffectEvent, useState, type ReactNode } from "react";
import { Icon } from "../../ui/icons";
import type { StrategyId } from "../../api/types";
import { axisUnit } from "../../plots/figure";
import { runAction, useAction, useActionButton } from "../../lab/actions";
import { cursor, useCursor } from "../../lab/cursor";
import type { ResultView } from "../../lab/resultView";
import classes from "./car.module.css";
import { Lane, Arrow } from "./Lane";
import { restingCursor, dimensionsOf, scaleOf, seenRoad } from "./geometry";
import { Card } from "../../ui/Card";
import { formatExact, formatNumber } from "../../units/format";
import { valueAt } from "../../lib/samples";
import { Choice, labelled } from "../../ui/Entry";

const SPEEDS = [
  { value: "0.05", label: "1/20 speed" },
  { value: "0.1", label: "1/10 speed" },
  { value: "0.25", label: "1/4 speed" },
  { value: "1", label: "real time" },
];
/** Heights are drawn this much larger than lengths, or nobody would see them. */
const EXAGGERATIONS = [1, 2, 5, 10].map((factor) => ({ value: String(factor), label: `heights × ${factor}` }));
const NONE = "";

export function CarView({ resultView }: { readonly resultView: ResultView }) {
  const { ref, width } = useElementSize<HTMLDivElement>();
  const [followed, setFollowed] = useState<StrategyId>(NONE);
  const [second, setSecond] = useState<StrategyId>(NONE);
  const [speed, setSpeed] = useState("0.25");
  const [exaggeration, setExaggeration] = useState("5");
  const [playing, setPlaying] = useState(false);

  const first = resultView.strategies.find(({ id }) => id === followed) ?? resultView.strategies[0];
  const other = resultView.strategies.find(({ id }) => id === second && id !== first?.id);
  const names = labelled(resultView.strategies);

  const driven = useEffectEvent(() => ({ resultView, strategy: first?.id ?? "", speed: Number(speed) }));
  useEffect(() => (playing ? play(() => driven()) : undefined), [playing]);

  useAction("play", first ? () => setPlaying(!playing) : null);

  if (!first) return null;
  return (
    <Card className={classes.view ?? ""} aria-label="The moving car">
      <div ref={ref} style={{ position: "relative" }}>
        {[first, ...(other ? [other] : [])].map((strategy) => (
          <Lane
            key={strategy.id}
            resultView={resultView}
            strategy={strategy}
            width={width}
            exaggeration={Number(exaggeration)}
          />
        ))}
        {width > 0 && <Key resultView={resultView} width={width} exaggeration={Number(exaggeration)} />}
      </div>
      <Group gap="0.5rem" p="0.35rem 0.6rem" style={{ borderTop: "1px solid var(--line)" }} data-unprinted>
        <ActionIcon
          data-hint={playing ? "Pause (Space)" : "Play (Space)"}
          variant="light"
          size={30}
          aria-label={playing ? "Pause" : "Play"}
          onClick={() => runAction("play")}
        >
          {playing ? <Icon name="PlayerPauseFilled" size={15} /> : <Icon name="PlayerPlayFilled" size={15} />}
        </ActionIcon>
        <Scrubber resultView={resultView} />
        <Options>
          <Choice aria-label="Playing speed" data={SPEEDS} value={speed} onPick={setSpeed} />
          <Choice
            aria-label="Exaggeration of heights"
            data={EXAGGERATIONS}
            value={exaggeration}
            onPick={setExaggeration}
          />
          <Choice aria-label="Car shown" data={names} value={first.id} onPick={setFollowed} />
          <Choice
            aria-label="Second car"
            data={[{ value: NONE, label: "no second car" }, ...names.filter(({ value }) => value !== first.id)]}
            value={other?.id ?? NONE}
            onPick={setSecond}
          />
        </Options>
        <WhyButton />
      </Group>
    </Card>
  );
}

/** What the controller saw and planned at the cursor. */
function WhyButton() {
  const { label, ...button } = useActionButton("instant");
  return (
    <Button variant="default" {...button}>
      {label}
    </Button>
  );
}

function Scrubber({ resultView }: { readonly resultView: ResultView }) {
  const [low, high] = resultView.range;
  const at = useCursor(resultView.axis) ?? restingCursor(resultView);
  return (
    <input
      type="range"
      style={{ flex: "1 1 6rem", minWidth: "6rem", height: 24, margin: 0, accentColor: "var(--accent)" }}
      aria-label="Cursor"
      aria-valuetext={`${at.toFixed(2)} ${axisUnit(resultView.axis)}`}
      min={low}
      max={high}
      step={(high - low) / 1000}
      value={Math.min(high, Math.max(low, at))}
      onChange={(event) => cursor.set(resultView.axis, Number(event.currentTarget.value))}
    />
  );
}

interface Props {
  readonly resultView: ResultView;
  readonly width: number;
  readonly exaggeration: number;
}

/** The scales of the drawing: how much larger heights are than lengths, and how long the arrow of the largest force is. */
export function Key({ resultView, width, exaggeration }: Props) {
  const size = dimensionsOf(resultView.shown.scenario, { front: null, rear: null });
  const length = scaleOf(width, exaggeration, size).newton * size.forceLimit;
  const isSeenElsewhere = resultView.strategies.some((each) => seenRoad(resultView.shown.scenario, each, 1) !== null);
  return (
    <Group
      component="span"
      gap="0.35rem"
      wrap="nowrap"
      pos="absolute"
      bottom="0.1rem"
      right="0.5rem"
      maw="calc(100% - 1rem)"
      px="0.3rem"
      fz="xs"
      c="dimmed"
      className={classes.key}
    >
      {isSeenElsewhere && "dashed: the road as previewed · "}
      {size.reboundRatio !== 1 && `dampers: rebound ${formatNumber(size.reboundRatio)} × compression · `}
      heights × {exaggeration} · force {formatExact(size.forceLimit / 1000, "kN")} =
      <svg width={length} height={8} aria-hidden>
        <g transform="translate(0 4) rotate(90)">
          <Arrow length={length} />
        </g>
      </svg>
    </Group>
  );
}

/** What is set more seldom: in the row where there is room for it, behind a button on a phone. */
export function Options({ children }: { readonly children: ReactNode }) {
  const narrow = useMediaQuery("(max-width: 47.99em)", false, { getInitialValueInEffect: false });
  if (!narrow) return children;
  return (
    <Popover position="bottom-end" withinPortal trapFocus>
      <Popover.Target>
        <ActionIcon variant="default" size={30} aria-label="Options of the moving car">
          <Icon name="AdjustmentsHorizontal" size={15} />
        </ActionIcon>
      </Popover.Target>
      <Popover.Dropdown role="dialog" aria-label="Options of the moving car">
        <Stack gap="xs">{children}</Stack>
      </Popover.Dropdown>
    </Popover>
  );
}

/** Where the cursor is after `elapsed` seconds of the run, for one strategy; starts over past the range's end. */
function advance(resultView: ResultView, strategy: string, from: number, elapsed: number): number {
  const series = resultView.series[strategy];
  const [low, high] = resultView.range;
  if (from >= high || from < low) return low;
  if (resultView.axis === "time") return Math.min(high, from + elapsed);
  const { position, time } = series ?? {};
  if (!position || !time) return from;
  const now = valueAt(position, time, from);
  const next = now === null ? null : valueAt(time, position, now + elapsed);
  return next === null ? high : Math.min(high, next);
}

interface Driven {
  readonly resultView: ResultView;
  readonly strategy: StrategyId;
  readonly speed: number;
}

/** Runs until the returned function is called; what is driven is asked anew for every frame. */
function play(driven: () => Driven): () => void {
  let frame = 0;
  let last = performance.now();
  const step = (now: number) => {
    const { resultView, strategy, speed } = driven();
    const elapsed = Math.min(0.1, (now - last) / 1000) * speed;
    last = now;
    const from = cursor.get(resultView.axis) ?? restingCursor(resultView);
    cursor.set(resultView.axis, advance(resultView, strategy, from, elapsed));
    frame = requestAnimationFrame(step);
  };
  frame = requestAnimationFrame(step);
  return () => cancelAnimationFrame(frame);
}
