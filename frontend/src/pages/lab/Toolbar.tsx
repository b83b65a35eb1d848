/** Which strategies are shown, over what, and which part of the run. */

import { Button, SegmentedControl, Tooltip } from "@mantine/core";
import { memo, useLayoutEffect, useRef } from "react";
import type { Strategy } from "../../api/types";
import type { ViewZoom } from "../../lab/address";
import { switchAxis } from "../../lab/axis";
import { useLabContext, useView } from "../../lab/context";
import { makeScene } from "../../lab/resultView";
import { RoadsSelect } from "./RoadsSelect";
import { StrategyChoice } from "./StrategyChoice";
import bar from "../../ui/toolbar.module.css";

interface Props {
  readonly strategies: readonly Strategy[];
  /** What the plots show of the run; `null` while there is none. */
  readonly part: "bump" | "whole" | "range" | null;
  readonly hasBump: boolean;
}

export const Toolbar = memo(function Toolbar({ strategies, part, hasBump }: Props) {
  const { router, lab } = useLabContext();
  const { axis } = useView();
  const ref = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => (ref.current ? publishHeight(ref.current) : undefined), []);
  return (
    <div ref={ref} className={bar.toolbar}>
      <StrategyChoice strategies={strategies} />
      <div className={bar.tools}>
        <RoadsSelect />
        <SegmentedControl
          size="xs"
          aria-label="Plots over"
          value={axis}
          data={[
            { value: "distance", label: "Distance" },
            { value: "time", label: "Time" },
          ]}
          onChange={(next) => {
            const { shown, strategies: selected } = lab.get();
            switchAxis(router, shown && makeScene(shown, strategies, selected, router.get().view), next);
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
  const { router } = useLabContext();
  return (
    <Tooltip label={tip} openDelay={500}>
      <Button
        size="xs"
        variant={shown ? "light" : "default"}
        aria-pressed={shown}
        disabled={disabled}
        onClick={() => router.setView({ zoom })}
      >
        {label}
      </Button>
    </Tooltip>
  );
}
