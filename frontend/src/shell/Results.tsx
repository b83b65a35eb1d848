/** Everything that shows a result, or says why there is none. */

import type { Catalogue, FigureTemplate, Strategy } from "../api/types";
import { CarView } from "../car/CarView";
import { PlotGrid } from "../plots/PlotGrid";
import { useDesk, useLab } from "../state/context";
import type { Scene } from "../state/scene";
import { Tables } from "../tables/Tables";
import { CouldNotLoad, Loading, NoHistories, NotFound, NothingChosen } from "./Blank";
import classes from "./shell.module.css";
import { RoadsNote } from "./RoadsNote";
import { StageLegend } from "./StageLegend";

interface Props {
  readonly strategies: readonly Strategy[];
  readonly catalogue: Catalogue | undefined;
  readonly figures: Readonly<Record<string, FigureTemplate>> | undefined;
  readonly scene: Scene | null;
}

export function Results({ strategies, catalogue, figures, scene }: Props) {
  const failure = useLab((state) => state.failure);
  const none = useLab((state) => state.strategies.length === 0);
  const shown = useLab((state) => state.shown !== null);
  const { lab } = useDesk();
  const stale = useLab((state) => state.stale);
  if (failure?.kind === "notFound") return <NotFound />;
  if (none) return <NothingChosen suggestion={strategies.map(({ id }) => id)} />;
  if (failure?.kind === "failed" && !shown) return <CouldNotLoad message={failure.message} onRetry={lab.openPaper} />;
  if (!scene || !catalogue || !figures || scene.ids.length === 0) return <Loading />;
  const meta = Object.values(figures)[0]?.layout.meta;
  const { missing } = scene.shown;
  return (
    <div
      className={classes.results}
      data-stale={stale || undefined}
      data-testid="results"
      data-source={scene.shown.source}
      data-run={scene.shown.runId ?? undefined}
    >
      <RoadsNote scene={scene} />
      <Tables scene={scene} catalogue={catalogue} figures={figures} />
      {missing === null ? (
        <>
          <CarView scene={scene} />
          {meta && <StageLegend scene={scene} catalogue={catalogue} meta={meta} />}
          <PlotGrid figures={figures} scene={scene} />
        </>
      ) : (
        <NoHistories reason={missing} />
      )}
    </div>
  );
}
