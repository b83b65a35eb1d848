/** Under which strategies each point runs. */

import { Checkbox, Group } from "@mantine/core";
import type { Strategy, StrategyId } from "../../api/types";
import { StrategyName } from "../../ui/StrategyKey";

interface Props {
  readonly strategies: readonly Strategy[];
  readonly selected: readonly StrategyId[];
  readonly error: string | undefined;
  readonly onChange: (selected: readonly StrategyId[]) => void;
}

export function StrategyChoice({ strategies, selected, error, onChange }: Props) {
  const inOrder = (ids: readonly StrategyId[]) => strategies.map(({ id }) => id).filter((id) => ids.includes(id));
  return (
    <Checkbox.Group
      label="Strategies"
      size="xs"
      value={[...selected]}
      error={error}
      onChange={(ids) => onChange(inOrder(ids))}
    >
      <Group gap="0.5rem 1.2rem" align="stretch" mt="0.4rem">
        {strategies.map((strategy) => (
          <Checkbox key={strategy.id} value={strategy.id} label={<StrategyName strategy={strategy} />} />
        ))}
      </Group>
    </Checkbox.Group>
  );
}
