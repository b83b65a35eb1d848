/** Puts a tuning together, over those there are. */

import { Skeleton } from "@mantine/core";
import { usePageScenario } from "../../features/scenarioSource/scenarioSource";
import { Page } from "../../ui/Page";
import { NewTuning } from "./NewTuning";
import { TuningList } from "./TuningList";
import classes from "./tuner.module.css";
import { useNumericCatalogues } from "./useNumericCatalogues";

export function TunerPage() {
  const { catalogues, fault } = useNumericCatalogues();
  const source = usePageScenario();
  const lead =
    "Searches the weights of a strategy that minimise an objective on a few training roads: the paper’s normalised sum (Eq. 16), peaks, or any figure, within limits. Several objectives give a Pareto front. The paper’s weights are the first trial. At the end the best ones are compared with them on validation roads: this shows weights that fit only the training roads.";
  return (
    <Page title="Weight tuner" heading="Weight tuner" what="page" lead={lead} faults={[fault]}>
      {catalogues ? (
        <div className={classes.columns}>
          <NewTuning {...catalogues} source={source} />
          <TuningList {...catalogues} />
        </div>
      ) : (
        <div className={classes.columns} aria-busy aria-label="Loading the form">
          <Skeleton height={620} radius={8} />
          <Skeleton height={220} radius={8} />
        </div>
      )}
    </Page>
  );
}
