/** The scales of the drawing: how much larger heights are than lengths, and how long the arrow of the largest force is. */

import { Group } from "@mantine/core";
import type { Scene } from "../../lab/resultView";
import { formatExact } from "../../units/format";
import { dimensionsOf, scaleOf } from "./layout";
import { Arrow } from "./parts";

interface Props {
  readonly scene: Scene;
  readonly width: number;
  readonly exaggeration: number;
}

export function Key({ scene, width, exaggeration }: Props) {
  const size = dimensionsOf(scene.shown.scenario, { front: null, rear: null });
  const length = scaleOf(width, exaggeration, size).newton * size.forceLimit;
  return (
    <Group
      component="span"
      gap="0.35rem"
      wrap="nowrap"
      pos="absolute"
      bottom="0.2rem"
      right="0.8rem"
      fz="xs"
      c="dimmed"
    >
      heights × {exaggeration} · force {formatExact(size.forceLimit / 1000, "kN")} =
      <svg width={length} height={8} aria-hidden>
        <g transform="translate(0 4) rotate(90)">
          <Arrow length={length} />
        </g>
      </svg>
    </Group>
  );
}
