/** Over how many roads the exact run goes. */

import { NativeSelect, Tooltip } from "@mantine/core";
import { useLabContext, useLab, useReadOnly } from "../../lab/context";

const CHOICES = [1, 5, 10, 20];

export function RoadsSelect() {
  const { lab } = useLabContext();
  const roads = useLab((state) => state.roads);
  const readOnly = useReadOnly();
  const choices = CHOICES.includes(roads) ? CHOICES : [...CHOICES, roads].sort((a, b) => a - b);
  return (
    <Tooltip
      label="Peaks on one road are partly random; several roads give a mean with a 95 % interval"
      multiline
      w={240}
      openDelay={500}
    >
      <NativeSelect
        size="xs"
        aria-label="Roads"
        disabled={readOnly}
        value={String(roads)}
        data={choices.map((count) => ({ value: String(count), label: count === 1 ? "1 road" : `${count} roads` }))}
        onChange={(event) => lab.setRoads(Number(event.currentTarget.value))}
      />
    </Tooltip>
  );
}
