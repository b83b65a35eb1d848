/** What a sweep's plot shows: which figure, over which field, under which strategies. */

import { NativeSelect, Select } from "@mantine/core";
import type { Batch, Strategy } from "../api/types";
import type { Markers } from "../plots/markers";
import bar from "../shell/toolbar.module.css";
import { titleWithUnit } from "../units/format";
import classes from "./batch.module.css";
import { optionsOf, type Figure } from "./figures";
import { MarkerKey } from "./MarkerKey";
import type { BatchView } from "./view";

interface Props {
  readonly batch: Batch;
  readonly strategies: readonly Strategy[];
  readonly markers: Markers;
  readonly figures: readonly Figure[];
  readonly x: Batch["fields"][number];
  readonly y: Figure;
  readonly view: BatchView;
  readonly onView: (change: Partial<BatchView>) => void;
}

export function PlotTools({ batch, strategies, markers, figures, x, y, view, onView }: Props) {
  return (
    <div className={classes.plotTools}>
      <NativeSelect
        size="xs"
        label="Over"
        value={x.name}
        data={batch.fields.map(({ name, title, unit }) => ({ value: name, label: titleWithUnit(title, unit) }))}
        onChange={(event) => onView({ x: event.currentTarget.value })}
      />
      <Select
        size="xs"
        label="Figure"
        className={classes.figureSelect ?? ""}
        searchable
        allowDeselect={false}
        value={y.key}
        maxDropdownHeight={320}
        data={optionsOf(figures)}
        onChange={(key) => key !== null && onView({ y: key })}
      />
      <div className={classes.plotChips} role="group" aria-label="Strategies">
        {strategies.map((strategy) => {
          const on = !view.hidden.includes(strategy.id);
          return (
            <button
              key={strategy.id}
              type="button"
              className={bar.chip}
              aria-pressed={on}
              onClick={() => onView({ hidden: on ? [...view.hidden, strategy.id] : view.hidden.filter((id) => id !== strategy.id) })}
            >
              <MarkerKey strategy={strategy} symbol={markers[strategy.id]} />
              {strategy.label}
            </button>
          );
        })}
      </div>
    </div>
  );
}
