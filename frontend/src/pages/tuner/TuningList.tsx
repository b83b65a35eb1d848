/** The tunings there are. */

import type { Strategy } from "../../api/types";
import type { Figure } from "../../server/metrics";
import { JobList } from "../../jobs/JobList";
import { TUNING } from "../../jobs/useJob";
import { ofLimit, ofObjective } from "./figures";

interface Props {
  readonly strategies: readonly Strategy[];
  readonly figures: readonly Figure[];
}

export function TuningList({ strategies, figures }: Props) {
  return (
    <JobList
      kind={TUNING}
      title="Earlier tunings"
      none="None yet. Each one you start stays here with all its trials."
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
