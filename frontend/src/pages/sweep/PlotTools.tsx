/** What a sweep's plot shows: of which kind it is, which metric, over which field, under which strategies. */

import { Group, SegmentedControl, Select } from "@mantine/core";
import { useState } from "react";
import { StrategyChip } from "../../ui/StrategyKey";
import { Choice, Entry, labelled } from "../../ui/Entry";
import { titleWithUnit, formatInput } from "../../units/format";
import { optionsOf, type Metric } from "../../server/metrics";
import { type PlotKind, NONE, useMarkers, type SweepParts } from "./view";
import { parseQuantity } from "../../units/quantity";
import { useCatalogues } from "../../server/useCatalogues";
import type { Strategy } from "../../api/types";
import { outlineOf } from "../../plots/markers";

type Props = Pick<SweepParts, "strategies" | "shown" | "view" | "onView">;

const LABELS: Readonly<Record<PlotKind, string>> = { points: "Curves", map: "Map", trade_off: "Trade-off" };

export function PlotTools({ strategies, shown, view, onView }: Props) {
  const { figures } = useCatalogues();
  const { kind, defaultKind, axes } = shown;
  const metric = (label: string, figure: Metric, onPick: (key: string) => void) => (
    <Select
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
        aria-label="Plot"
        value={kind}
        data={[defaultKind, "trade_off" as const].map((value) => ({ value, label: LABELS[value] }))}
        onChange={(plot) => onView({ plot: plot === "trade_off" ? plot : null })}
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
              <StrategyChip
                key={strategy.id}
                {...{ strategy }}
                icon={<MarkerKey strategy={strategy} />}
                pressed={on}
                onClick={() =>
                  onView({
                    hidden: on ? [...view.hidden, strategy.id] : view.hidden.filter((id) => id !== strategy.id),
                  })
                }
              />
            );
          })}
        </Group>
      )}
    </Group>
  );
}

type MapToolsProps = Pick<SweepParts, "strategies" | "shown" | "onView">;

/** Whose map is drawn, compared with which strategy, and where it has a line. */
function MapTools({ strategies, shown, onView }: MapToolsProps) {
  const { strategy, against } = shown;
  const options = labelled(strategies);
  return (
    <>
      <Choice
        label="Strategy"
        value={strategy}
        data={options}
        onPick={(id) => onView({ strategy: id, against: against ?? NONE, threshold: null })}
      />
      <Choice
        label="Change against"
        value={against ?? NONE}
        data={[{ value: NONE, label: "Nothing: its own values" }, ...options.filter(({ value }) => value !== strategy)]}
        onPick={(id) => onView({ against: id, threshold: null })}
      />
      <LineEntry key={`${shown.y.key} ${strategy} ${against ?? ""}`} {...{ shown, onView }} />
    </>
  );
}

function LineEntry({ shown: { threshold, mapUnit }, onView }: Pick<MapToolsProps, "shown" | "onView">) {
  const [typed, setTyped] = useState(() => (threshold === null ? "" : formatInput(threshold)));
  const read = (text: string) => (text.trim() === "" ? null : parseQuantity(text, mapUnit));
  const parsed = read(typed);
  const change = (text: string) => {
    setTyped(text);
    const next = read(text);
    if (next === null || next.ok) onView({ threshold: next?.value ?? NONE });
  };
  return (
    <Entry
      w="9rem"
      label="Line at"
      placeholder="no line"
      value={typed}
      unit={mapUnit}
      error={parsed?.ok === false ? parsed.message : undefined}
      onType={change}
    />
  );
}

/** A strategy's marker as the plot draws it. */
export function MarkerKey({ strategy: { id, colour } }: { readonly strategy: Pick<Strategy, "id" | "colour"> }) {
  const symbol = useMarkers()[id] ?? "circle";
  return (
    <svg width="14" height="14" viewBox="-7 -7 14 14" aria-hidden style={{ flex: "none" }} data-marker={symbol}>
      <path d={outlineOf(symbol, 4.4)} fill={colour} stroke="var(--muted)" strokeWidth="0.75" />
    </svg>
  );
}
