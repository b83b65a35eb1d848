/** Which strategies are shown, over what, and which part of the run. */

import { Button, SegmentedControl } from "@mantine/core";
import { memo, useLayoutEffect, useRef } from "react";
import type { Strategy } from "../../api/types";
import type { ViewZoom, Axis } from "../../lab/address";
import { useLabContext, useView, useLab, useReadOnly } from "../../lab/context";
import { makeResultView, axisKey, type ResultView } from "../../lab/resultView";
import { StrategyChoice } from "./StrategyChoice";
import bar from "../../ui/toolbar.module.css";
import { valueAt } from "../../lib/samples";
import { cursor } from "../../lab/cursor";
import type { LabAddress } from "../../lab/labAddress";
import { Choice } from "../../ui/Entry";

interface Props {
  readonly strategies: readonly Strategy[];
  /** What the plots show of the run; `null` while there is none. */
  readonly part: "bump" | "whole" | "range" | null;
  readonly hasBump: boolean;
}

export const Toolbar = memo(function Toolbar({ strategies, part, hasBump }: Props) {
  const { labAddress, lab } = useLabContext();
  const { axis } = useView();
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
          data={[
            { value: "distance", label: "Distance" },
            { value: "time", label: "Time" },
          ]}
          onChange={(next) => {
            const { shown, strategies: selected } = lab.get();
            switchAxis(labAddress, shown && makeResultView(shown, strategies, selected, labAddress.get().view), next);
          }}
        />
        <Button.Group>
          <ZoomButton label="Bump" tip="Zoom to the bump" zoom={null} shown={part === "bump"} disabled={!hasBump} />
          <ZoomButton
            label="Whole run"
            tip="Show the whole run (or double click a plot)"
            zoom="whole"
            shown={part === "whole"}
            disabled={part === null}
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
  readonly label: string;
  readonly tip: string;
  readonly zoom: ViewZoom;
  readonly shown: boolean;
  readonly disabled: boolean;
}

function ZoomButton({ label, tip, zoom, shown, disabled }: ZoomProps) {
  const { labAddress } = useLabContext();
  return (
    <Button
      data-hint={tip}
      variant={shown ? "light" : "default"}
      aria-pressed={shown}
      disabled={disabled}
      onClick={() => labAddress.setView({ zoom })}
    >
      {label}
    </Button>
  );
}

/** From distance to time and back: zoom and cursor stay on the same piece of the run. */
function switchAxis(router: LabAddress, resultView: ResultView | null, axis: Axis): void {
  const first = resultView?.ids[0];
  const series = first === undefined ? undefined : resultView?.series[first];
  const from = resultView && series?.[axisKey(resultView.axis)];
  const to = series?.[axisKey(axis)];
  const convert = (x: number) => (from && to ? valueAt(from, to, x) : null);

  const { zoom } = router.get().view;
  const at = resultView && cursor.get(resultView.axis);
  cursor.set(axis, at === null ? null : convert(at));
  router.setView({ axis, zoom: converted(zoom, convert) });
}

function converted(zoom: ViewZoom, convert: (x: number) => number | null): ViewZoom {
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
