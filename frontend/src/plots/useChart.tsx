/** A chart in the colours of the page, and the button that saves it in those of light paper. */

import { useComputedColorScheme } from "@mantine/core";
import { useSelector } from "@tanstack/react-store";
import { useMemo, useRef } from "react";
import type { Strategy } from "../api/types";
import { printing } from "../lib/printing";
import { useSchemeColours, useStrategies } from "../server/useCatalogues";
import { FigureButton } from "./FigureButton";
import { ON_PAPER, PALETTES, type Palette } from "./palettes";
import type { ChartOnPaper } from "./paperChart";

/** How it is drawn. */
export interface Look {
  readonly palette: Palette;
  readonly scheme: "light" | "dark";
  /** All there are, in colours that stand out. */
  readonly strategies: readonly Strategy[];
  /** For a file: whole, and of nothing that can be pressed. */
  readonly onPaper: boolean;
}

interface Props<Drawn> {
  readonly title: string;
  /** Name of the file without its ending. */
  readonly file: string;
  /** `null` while there is nothing to draw; the same one until something else is drawn. */
  readonly draw: ((look: Look) => Drawn) | null;
}

/** What `Chart` takes, and the button; the code that makes the file is loaded with its menu. */
export function useChart<Drawn extends ChartOnPaper>({ title, file, draw }: Props<Drawn>) {
  const screen = useComputedColorScheme("light");
  const scheme = useSelector(printing) ? "light" : screen;
  const light = useStrategies();
  const strategies = useSchemeColours(light);
  const hostRef = useRef<HTMLDivElement>(null);
  const drawn = useMemo(
    () => draw?.({ palette: PALETTES[scheme], scheme, strategies, onPaper: false }),
    [draw, scheme, strategies],
  );
  const onPaper =
    draw && ((): ChartOnPaper => draw({ palette: ON_PAPER, scheme: "light", strategies: light, onPaper: true }));
  const button = onPaper && (
    <FigureButton
      source={{
        title,
        file,
        paper: async (size) => {
          const { asZoomed, paperChart } = await import("./paperChart");
          const { figure, ...rest } = onPaper();
          return paperChart({ figure: asZoomed(figure, hostRef.current), ...rest }, size);
        },
        csv: async () =>
          (await import("./paperChart")).chartCsv(onPaper(), [`Ridelab: ${title}`, `page: ${window.location.href}`]),
      }}
    />
  );
  return { drawn, chart: { hostRef, figure: drawn ? drawn.figure : null }, button };
}
