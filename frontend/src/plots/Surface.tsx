/** The drawn part of a panel: a canvas, which follows a slider at any pace. */

import { useElementSize } from "@mantine/hooks";
import { useCallback, useLayoutEffect, useRef } from "react";
import { endFirstView } from "../lib/firstCurves";
import { printing } from "../lib/printing";
import { useSelector, type ReadonlyAtom } from "@tanstack/react-store";
import { drawOnCanvas } from "./canvas";
import type { Curves } from "./curves";
import { withVerticalRange } from "./figure";
import type { PanelFigure } from "./plotly";
import classes from "./plots.module.css";

/** Curves that change without anything being rendered anew. */
export type CurvesSource = Pick<ReadonlyAtom<Curves>, "get" | "subscribe">;

interface Props<Drawn> {
  readonly curves: Pick<ReadonlyAtom<Drawn>, "get" | "subscribe">;
  readonly build: (curves: Drawn) => PanelFigure;
  /** Off screen nothing is computed: what was drawn stays. */
  readonly visible: boolean;
}

type Range = readonly [number, number];

/** Pixels of paper for one of the screen: 288 to the inch. */
const PAPER_RATIO = 3;

export function Surface<Drawn extends Pick<Curves, "live">>({ curves, build, visible }: Props<Drawn>) {
  const { ref: sizeRef, width, height } = useElementSize<HTMLDivElement>();
  const canvas = useRef<HTMLCanvasElement>(null);
  const shownRange = useRef<Range>(null);
  const printed = useSelector(printing);

  useLayoutEffect(() => {
    const drawn = canvas.current;
    if (!visible || width === 0 || !drawn) return undefined;
    const { fontFamily } = getComputedStyle(drawn);
    const draw = () => {
      const figure = build(curves.get());
      const needed = figure.layout.yaxis.range;
      const range = curves.get().live && keepsRange(shownRange.current, needed) ? shownRange.current : needed;
      shownRange.current = range;
      const ratio = printed ? PAPER_RATIO : window.devicePixelRatio;
      drawOnCanvas(
        drawn,
        range === needed ? figure : withVerticalRange(figure, range),
        { width, height },
        ratio,
        fontFamily,
      );
      endFirstView();
      const count = String(figure.data.length);
      if (drawn.dataset.drawn !== count) drawn.dataset.drawn = count;
    };
    draw();
    const following = curves.subscribe(draw);
    return () => following.unsubscribe();
  }, [curves, build, visible, width, height, printed]);

  return (
    <div ref={sizeRef} className={classes.surface}>
      <canvas ref={canvas} className={classes.canvas} aria-hidden />
    </div>
  );
}

const STILL = { get: () => ({ live: false }), subscribe: () => ({ unsubscribe: () => undefined }) };

/** A figure that is drawn when it is rendered. */
export function StillSurface({ figure }: { readonly figure: PanelFigure }) {
  return <Surface curves={STILL} build={useCallback(() => figure, [figure])} visible />;
}

/** A range already shown is kept while live curves fit in and fill at least this part of it: axes must not flicker. */
const LEAST_FILLED = 0.55;

export function keepsRange(shown: Range | null, needed: Range): shown is Range {
  if (shown === null) return false;
  const fits = needed[0] >= shown[0] && needed[1] <= shown[1];
  return fits && needed[1] - needed[0] >= LEAST_FILLED * (shown[1] - shown[0]);
}
