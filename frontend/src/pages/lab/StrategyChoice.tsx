/** Which strategies are shown: a chip for each in use, a menu with all of them. */

import { Button, Menu } from "@mantine/core";
import { memo, useState } from "react";
import type { Strategy, StrategyId } from "../../api/types";
import { Icon } from "../../ui/icons";
import { STRATEGIES } from "../../ui/manual";
import { useLab, useLabContext } from "../../lab/context";
import { isolateWhilePointed } from "../../lab/isolated";
import { StrategyKey } from "../../ui/StrategyKey";
import bar from "../../ui/toolbar.module.css";
import { Note } from "../../ui/Messages";

export const StrategyChoice = memo(function StrategyChoice({
  strategies,
}: {
  readonly strategies: readonly Strategy[];
}) {
  const { selected, toggle } = useSelected(strategies);
  // A shared result has what it has: other strategies would be a new run.
  const summaries = useLab((state) => (state.shared ? state.shown?.summaries : undefined));
  const chips = useChips(selected);
  return (
    <div className={bar.choice}>
      <div className={bar.chips} role="group" aria-label="Strategies">
        {strategies
          .filter(({ id }) => chips.includes(id))
          .map((strategy) => (
            <button
              key={strategy.id}
              data-hint={strategy.description}
              type="button"
              className={bar.chip}
              disabled={summaries !== undefined && !(strategy.id in summaries)}
              aria-pressed={selected.includes(strategy.id)}
              onClick={() => toggle(strategy.id)}
              {...isolateWhilePointed(strategy.id)}
            >
              <StrategyKey strategy={strategy} />
              {strategy.label}
            </button>
          ))}
      </div>
      <Menu position="bottom-start" width={300}>
        <Menu.Target>
          <Button
            data-unprinted
            flex="none"
            rightSection={<Icon name="ChevronDown" size={14} />}
            disabled={strategies.length === 0}
          >
            Strategies
          </Button>
        </Menu.Target>
        <Menu.Dropdown>
          {strategies.map((strategy) => (
            <Menu.CheckboxItem
              key={strategy.id}
              checked={selected.includes(strategy.id)}
              disabled={summaries !== undefined && !(strategy.id in summaries)}
              title={strategy.fault ?? strategy.description}
              rightSection={<StrategyKey strategy={strategy} />}
              onChange={() => toggle(strategy.id)}
            >
              {strategy.label}
              {strategy.source && <Note>{strategy.fault ?? strategy.source.file}</Note>}
            </Menu.CheckboxItem>
          ))}
          <Menu.Divider />
          <Menu.Item
            component="a"
            href={STRATEGIES}
            target="_blank"
            rightSection={<Icon name="ExternalLink" size={14} />}
          >
            What each of them does
          </Menu.Item>
        </Menu.Dropdown>
      </Menu>
    </div>
  );
});

/** Those that are on, or were since the page opened: what is switched off keeps its chip. */
function useChips(selected: readonly string[]): readonly string[] {
  const [used, setUsed] = useState(selected);
  const missing = selected.filter((id) => !used.includes(id));
  if (missing.length > 0) setUsed([...used, ...missing]);
  return used;
}

/** The strategies that are switched on, and how one is switched. */
export function useSelected(strategies: readonly Strategy[]) {
  const { lab } = useLabContext();
  const selected = useLab((state) => state.strategies);
  const toggle = (id: StrategyId) =>
    lab.setStrategies(strategies.map((each) => each.id).filter((other) => selected.includes(other) !== (other === id)));
  return { selected, toggle };
}
