/** What the lab shows of a run: the only part of the page that is rendered anew with each answer. */

import { Group } from "@mantine/core";
import { useMemo } from "react";
import type { Catalogue, FigureTemplate, Strategy } from "../../api/types";
import { useCompared } from "../../features/compare/useCompared";
import { usePaired } from "../../features/compare/usePaired";
import { SharedBanner } from "../../features/share/SharedBanner";
import { useLab, useView } from "../../lab/context";
import { partShown, withBaseline } from "../../lab/resultView";
import { CouldNotLoad } from "../../ui/Blank";
import { FromPage } from "./FromPage";
import { Results } from "./Results";
import classes from "../../ui/shell.module.css";
import { StatusLine } from "./StatusLine";
import { Toolbar } from "./Toolbar";

interface Props {
  readonly strategies: readonly Strategy[];
  readonly catalogue: Catalogue | undefined;
  readonly figures: Readonly<Record<string, FigureTemplate>> | undefined;
  /** Why the page's own lists could not be read. */
  readonly fault: string | undefined;
}

export function LabMain({ strategies, catalogue, figures, fault }: Props) {
  const shown = useLab((state) => state.shown);
  const selected = useLab((state) => state.strategies);
  const { axis, zoom, baseline, against, differences } = useView();
  const compared = useCompared();
  // Apart: another baseline leaves what is drawn as it is.
  const part = useMemo(
    () => (shown && strategies.length > 0 ? partShown(shown, strategies, selected, { axis, zoom }) : null),
    [shown, strategies, selected, axis, zoom],
  );
  const paired = usePaired(part, compared, { baseline, against });
  const scene = useMemo(
    () => part && withBaseline(part, { baseline, against, differences }, compared, paired),
    [part, baseline, against, differences, compared, paired],
  );
  return (
    <main className={classes.main}>
      <Group gap="0 1rem" align="baseline" justify="space-between" mt="0.45rem">
        <h1 className={classes.purpose}>
          What-if laboratory for active suspension. <span>LV: longitudinal (speed) and vertical control.</span>
        </h1>
        <FromPage />
      </Group>
      <SharedBanner strategies={strategies} catalogue={catalogue} figures={figures} />
      <Toolbar
        strategies={strategies}
        part={scene && (scene.range === scene.bump ? "bump" : scene.range === scene.whole ? "whole" : "range")}
        hasBump={scene !== null && scene.bump !== null}
      />
      <StatusLine position="page" />
      {fault === undefined ? (
        <Results {...{ strategies, catalogue, figures, scene }} />
      ) : (
        <CouldNotLoad message={fault} />
      )}
    </main>
  );
}
