/** Puts a tuning together, over those there are. */

import { usePageScenario } from "../../features/scenarioSource/scenarioSource";
import { Page } from "../../ui/Page";
import { NewTuning } from "./NewTuning";
import ui from "../../ui/ui.module.css";
import { useNumericCatalogues, ofLimit, ofObjective } from "./figures";
import type { Strategy } from "../../api/types";
import type { Metric } from "../../server/metrics";
import { JobList } from "../../jobs/JobList";
import { TUNING } from "../../jobs/useJob";

export function TunerPage() {
  const catalogues = useNumericCatalogues();
  const source = usePageScenario();
  const lead =
    "Searches the weights of a strategy that minimise an objective on a few training roads: the paper’s normalised sum (Eq. 16), peaks, or any figure, within limits. Several objectives give a Pareto front. The paper’s weights are the first trial. At the end the best ones are compared with them on validation roads: this shows weights that fit only the training roads.";
  return (
    <Page title="Weight tuner" heading="Weight tuner" what="page" lead={lead} faults={[]}>
      <div className={ui.beside}>
        <NewTuning {...catalogues} source={source} />
        <TuningList {...catalogues} />
      </div>
    </Page>
  );
}

interface Props {
  readonly strategies: readonly Strategy[];
  readonly figures: readonly Metric[];
}

/** The tunings there are. */
function TuningList({ strategies, figures }: Props) {
  return (
    <JobList
      kind={TUNING}
      title="Earlier tunings"
      none="None yet. Choose in the form what has to become small and start; each tuning stays here with all its trials."
      describe={({ strategy, objectives, limits }) => ({
        title: strategies.find(({ id }) => id === strategy)?.label ?? strategy,
        details: [
          objectives.map((each) => ofObjective(each, figures).label).join(", "),
          ...(limits.length > 0 ? [`within ${limits.map((each) => ofLimit(each, figures).label).join(", ")}`] : []),
        ],
      })}
    />
  );
}
