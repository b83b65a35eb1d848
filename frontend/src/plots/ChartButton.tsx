/** Saves a chart as it is drawn, in the colours of light paper; the code that makes the file is loaded with the menu. */

import type { RefObject } from "react";
import { FigureButton } from "./FigureButton";
import type { ChartOnPaper } from "./paperChart";
import type { FigureSource } from "./saved";

interface Props {
  readonly title: string;
  /** Name of the file without its ending. */
  readonly file: string;
  /** Where plotly draws it: the file shows what somebody has zoomed to. */
  readonly hostRef?: RefObject<HTMLElement | null>;
  readonly draw: () => ChartOnPaper;
}

export function ChartButton({ title, file, hostRef, draw }: Props) {
  const source: FigureSource = {
    title,
    file,
    paper: async (size) => {
      const { asZoomed, paperChart } = await import("./paperChart");
      const { figure, ...rest } = draw();
      return paperChart({ figure: asZoomed(figure, hostRef?.current ?? null), ...rest }, size);
    },
    csv: async () =>
      (await import("./paperChart")).chartCsv(draw(), [`Ridelab: ${title}`, `page: ${window.location.href}`]),
  };
  return <FigureButton source={source} />;
}
