/** The drawn part of a panel: a canvas, which follows a slider at any pace. */

import { useElementSize } from "@mantine/hooks";
import { useLayoutEffect, useRef } from "react";
import { endFirstView } from "../lib/firstCurves";
import { printing } from "../lib/printing";
import { useSelector } from "@tanstack/react-store";
import { drawOnCanvas } from "./canvas";
import { withVerticalRange } from "./figure";
import type { PanelFigure } from "./plotly";
import classes from "./plots.module.css";

interface Props {
  /** `null` leaves what was drawn. */
  readonly figure: PanelFigure | null;
  readonly live: boolean;
}

type Range = readonly [number, number];

/** Pixels of paper for one of the screen: 288 to the inch. */
const PAPER_RATIO = 3;

export function Surface({ figure, live }: Props) {
  const { ref: sizeRef, width, height } = useElementSize<HTMLDivElement>();
  const canvas = useRef<HTMLCanvasElement>(null);
  const shownRange = useRef<Range>(null);
  const printed = useSelector(printing);

  useLayoutEffect(() => {
    if (!figure || width === 0 || !canvas.current) return;
    const needed = figure.layout.yaxis.range;
    const range = live && keepsRange(shownRange.current, needed) ? shownRange.current : needed;
    shownRange.current = range;
    const ratio = printed ? PAPER_RATIO : window.devicePixelRatio;
    drawOnCanvas(
      canvas.current,
      range === needed ? figure : withVerticalRange(figure, range),
      { width, height },
      ratio,
    );
    endFirstView();
    canvas.current.dataset.drawn = String(figure.data.length);
  }, [figure, live, width, height, printed]);

  return (
    <div ref={sizeRef} className={classes.surface}>
      <canvas ref={canvas} className={classes.canvas} aria-hidden />
    </div>
  );
}

/** A range already shown is kept while live curves fit in and fill at least this part of it: axes must not flicker. */
const LEAST_FILLED = 0.55;

export function keepsRange(shown: Range | null, needed: Range): shown is Range {
  if (shown === null) return false;
  const fits = needed[0] >= shown[0] && needed[1] <= shown[1];
  return fits && needed[1] - needed[0] >= LEAST_FILLED * (shown[1] - shown[0]);
}
