/** What a sweep's plot shows: of which kind it is, which metric, over which field, under which strategies. */

import { Group, SegmentedControl, Select } from "@mantine/core";
import bar from "../../ui/toolbar.module.css";
import { Choice } from "../../ui/Entry";
import { titleWithUnit } from "../../units/format";
import type { AxisOf } from "../../features/sweep/axes";
import { optionsOf, type Figure } from "../../server/metrics";
import { MapTools } from "./MapTools";
import { MarkerKey } from "./MarkerKey";
import type { PlotKind } from "./view";
import type { SweepParts } from "./props";

interface Props extends Pick<SweepParts, "strategies" | "markers" | "figures" | "shown" | "view" | "onView"> {
  readonly axes: readonly AxisOf[];
}

const KINDS: readonly { readonly value: PlotKind; readonly label: string }[] = [
  { value: "points", label: "Curves" },
  { value: "map", label: "Map" },
  { value: "trade_off", label: "Trade-off" },
];

export function PlotTools({ axes, strategies, markers, figures, shown, view, onView }: Props) {
  const { kind, mappable } = shown;
  const offered = KINDS.filter(({ value }) => value !== "map" || mappable);
  const metric = (label: string, figure: Figure, onPick: (key: string) => void) => (
    <Select
      size="xs"
      label={label}
      flex="0 1 24rem"
      miw="12rem"
      searchable
      allowDeselect={false}
      value={figure.key}
      maxDropdownHeight={320}
      data={optionsOf(figures)}
      onChange={(key) => key !== null && onPick(key)}
    />
  );
  return (
    <Group gap="0.5rem 0.8rem" align="flex-end" p="0.6rem 0.9rem 0.3rem">
      <SegmentedControl
        size="xs"
        aria-label="Plot"
        value={kind}
        data={[...offered]}
        onChange={(plot) => onView({ plot })}
      />
      {kind === "trade_off"
        ? metric("Metric across", shown.versus, (versus) => onView({ versus }))
        : axes.length > 1 && (
            <Choice
              label="Over"
              value={shown.x.name}
              data={axes.map(({ name, title, unit }) => ({ value: name, label: titleWithUnit(title, unit) }))}
              onPick={(x) => onView({ x })}
            />
          )}
      {metric(kind === "trade_off" ? "Metric up" : "Metric", shown.y, (y) => onView({ y, threshold: null }))}
      {kind === "map" ? (
        <MapTools {...{ strategies, shown, onView }} />
      ) : (
        <Group gap="0.4rem" align="stretch" role="group" aria-label="Strategies">
          {strategies.map((strategy) => {
            const on = !view.hidden.includes(strategy.id);
            return (
              <button
                key={strategy.id}
                type="button"
                className={bar.chip}
                aria-pressed={on}
                onClick={() =>
                  onView({
                    hidden: on ? [...view.hidden, strategy.id] : view.hidden.filter((id) => id !== strategy.id),
                  })
                }
              >
                <MarkerKey strategy={strategy} symbol={markers[strategy.id]} />
                {strategy.label}
              </button>
            );
          })}
        </Group>
      )}
    </Group>
  );
}
