/** Which strategies are shown, over what, and which part of the run. */

import { Group, Button, SegmentedControl, Menu, Box } from "@mantine/core";
import { memo, useLayoutEffect, useRef, useState } from "react";
import { type Strategy, type StrategyId } from "../../api/types";
import { useAction, useActionButton, type ActionId } from "../../lab/actions";
import { type ViewZoom, type Axis } from "../../lab/address";
import { useLabContext, useView, useLab, useReadOnly } from "../../lab/context";
import { makeResultView, type ResultView } from "../../lab/resultView";
import bar from "../../ui/toolbar.module.css";
import { converted } from "./Panels";
import { cursor, isolateWhilePointed, holdIsolated, useIsolated } from "../../lab/cursor";
import { type LabAddress } from "../../lab/labAddress";
import { Choice, choicesOf } from "../../ui/Entry";
import { Icon } from "../../ui/icons";
import { STRATEGIES } from "../../ui/manual";
import { StrategyChip, StrategyKey, LineKey, StrategyName } from "../../ui/StrategyKey";
import { Note } from "../../ui/Messages";
import { useMediaQuery } from "@mantine/hooks";
import { useCatalogue, useFigures } from "../../server/useCatalogues";
import { layersOf } from "../../plots/curves";
import { stagedStrategy } from "../../plots/shapes";
import { useCurves } from "../../plots/useDetail";
import ui from "../../ui/ui.module.css";

interface Props {
  readonly strategies: readonly Strategy[];
  /** What the plots show of the run; `null` while there is none. */
  readonly part: "bump" | "whole" | "range" | null;
  readonly hasBump: boolean;
}

export const Toolbar = memo(function Toolbar({ strategies, part, hasBump }: Props) {
  const { labAddress, lab } = useLabContext();
  const { axis } = useView();
  const over = (next: Axis) => {
    const { shown, strategies: selected } = lab.get();
    switchAxis(labAddress, shown && makeResultView(shown, strategies, selected, labAddress.get().view), next);
  };
  useAction("axis", () => over(axis === "time" ? "distance" : "time"));
  const ref = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => (ref.current ? publishHeight(ref.current) : undefined), []);
  return (
    <div ref={ref} className={bar.toolbar}>
      <StrategyChoice strategies={strategies} />
      <div className={bar.tools} data-unprinted>
        <RoadsSelect />
        <SegmentedControl
          aria-label="Plots over"
          value={axis}
          data={choicesOf({ distance: "Distance", time: "Time" })}
          onChange={over}
        />
        <Button.Group>
          <ZoomButton id="bump" tip="Zoom to the bump" zoom={null} shown={part === "bump"} can={hasBump} />
          <ZoomButton
            id="whole"
            tip="Show the whole run (or double click a plot)"
            zoom="whole"
            shown={part === "whole"}
            can={part !== null}
          />
        </Button.Group>
      </div>
    </div>
  );
});

/** For what stays in view below it; the more strategies are on, the more rows it has. */
function publishHeight(toolbar: HTMLElement): () => void {
  const observer = new ResizeObserver(() =>
    document.documentElement.style.setProperty("--toolbar", `${toolbar.offsetHeight}px`),
  );
  observer.observe(toolbar);
  return () => observer.disconnect();
}

interface ZoomProps {
  readonly id: ActionId;
  readonly tip: string;
  readonly zoom: ViewZoom;
  readonly shown: boolean;
  readonly can: boolean;
}

function ZoomButton({ id, tip, zoom, shown, can }: ZoomProps) {
  const { labAddress } = useLabContext();
  useAction(id, can ? () => labAddress.setView({ zoom }) : null);
  const { label, ...button } = useActionButton(id);
  return (
    <Button data-hint={tip} variant={shown ? "light" : "default"} aria-pressed={shown} {...button}>
      {label}
    </Button>
  );
}

/** From distance to time and back: zoom and cursor stay on the same piece of the run. */
function switchAxis(router: LabAddress, resultView: ResultView | null, axis: Axis): void {
  const convert = (x: number) => resultView && converted(resultView, resultView.ids[0] ?? "", x, resultView.axis, axis);
  const { zoom } = router.get().view;
  const at = resultView && cursor.get(resultView.axis);
  cursor.set(axis, at === null ? null : convert(at));
  router.setView({ axis, zoom: zoomedAlike(zoom, convert) });
}

function zoomedAlike(zoom: ViewZoom, convert: (x: number) => number | null): ViewZoom {
  if (zoom === "whole" || zoom === null) return zoom;
  const [low, high] = [convert(zoom[0]), convert(zoom[1])];
  return low !== null && high !== null ? [low, high] : null;
}

const CHOICES = [1, 5, 10, 20];

/** Over how many roads the exact run goes. */
function RoadsSelect() {
  const { lab } = useLabContext();
  const roads = useLab((state) => state.roads);
  const readOnly = useReadOnly();
  const choices = CHOICES.includes(roads) ? CHOICES : [...CHOICES, roads].sort((a, b) => a - b);
  return (
    <Choice
      data-hint="Peaks on one road are partly random; several roads give a mean with a 95 % interval"
      aria-label="Roads"
      disabled={readOnly}
      value={String(roads)}
      data={choices.map((count) => ({ value: String(count), label: count === 1 ? "1 road" : `${count} roads` }))}
      onPick={(value) => lab.setRoads(Number(value))}
    />
  );
}

/** A chip for each strategy in use, a menu with all of them. */
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
      <Group gap="0.3rem 0.4rem" miw={0} mih={34} role="group" aria-label="Strategies">
        {strategies
          .filter(({ id }) => chips.includes(id))
          .map((strategy) => (
            <StrategyChip
              key={strategy.id}
              {...{ strategy }}
              icon={<StrategyKey strategy={strategy} />}
              pressed={selected.includes(strategy.id)}
              data-hint={strategy.description}
              disabled={summaries !== undefined && !(strategy.id in summaries)}
              onClick={() => toggle(strategy.id)}
              {...isolateWhilePointed(strategy.id)}
            />
          ))}
      </Group>
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

/** A swatch is small: the shading three times over, so that it can be told apart. */
const layered = (fill = "transparent") => Array<string>(3).fill(`linear-gradient(${fill}, ${fill})`).join(", ");

const BAND = {
  borderColor: "transparent",
  background: "linear-gradient(rgb(127 127 127 / 30%) 42%, rgb(127 127 127) 42% 58%, rgb(127 127 127 / 30%) 58%)",
};

export function StageLegend({ resultView }: { readonly resultView: ResultView }) {
  const catalogue = useCatalogue();
  const meta = Object.values(useFigures())[0]?.layout.meta;
  const stages = catalogue.stages.filter(({ key }) => key in (meta?.stage_fills ?? {}));
  const staged = resultView.strategies.find(({ id }) => id === stagedStrategy(resultView.summaries, resultView.ids));
  const airborne = resultView.ids.some((id) => Number(resultView.summaries[id]?.events.airborne_ms ?? 0) > 0);
  const hasBand = useCurves(resultView).roads !== undefined && !resultView.differences;
  const held = useIsolated();
  const isTouched = useMediaQuery("(hover: none)");
  const layers = resultView.differences ? [] : layersOf(resultView, resultView.shown.runId);
  const several = resultView.axis === "time" && resultView.ids.length > 1;
  return (
    <Group gap="0.2rem 1.1rem" m="0.1rem 0.2rem" fz="xs" c="dimmed">
      {resultView.ids.length > 1 &&
        resultView.strategies.map((strategy) => (
          <Button
            key={strategy.id}
            size="compact-xs"
            variant={held === strategy.id ? "default" : "subtle"}
            color="gray"
            fw={400}
            {...(held !== strategy.id && { c: "dimmed" })}
            aria-pressed={held === strategy.id}
            title={`Make ${strategy.label} stand out`}
            onClick={() => holdIsolated(strategy.id)}
            {...isolateWhilePointed(strategy.id)}
          >
            <StrategyName strategy={strategy} />
          </Button>
        ))}
      {stages.map(({ key, label, description }) => (
        <span key={key} title={description}>
          <span className={ui.area} style={{ background: layered(meta?.stage_fills[key]) }} /> {label}
        </span>
      ))}
      <span>
        <LineKey colour={meta?.neutral ?? "currentColor"} width={1.5} dash="4 2" /> limit, static load or target
      </span>
      {layers.map(({ name, line }, index) => (
        <span key={index} data-layer={name}>
          <LineKey {...line} /> {name}
        </span>
      ))}
      {hasBand && (
        <span>
          <span className={ui.area} style={BAND} /> range: minimum to maximum of {resultView.shown.over?.roads} roads
        </span>
      )}
      {(airborne || hasBand) && (
        <span>
          <span className={ui.area} style={{ background: "rgb(127 127 127 / 45%)" }} /> tyre off the road
          {hasBand && " on at least one road"}
        </span>
      )}
      {several && <span>Stages shaded for {staged?.label}; the marks on top: each strategy on the bump</span>}
      <Box component="span" ml="auto" data-unprinted>
        {isTouched ? "Slide along a plot to read it" : "Drag across a plot to zoom, double click for the whole run"}
      </Box>
    </Group>
  );
}
