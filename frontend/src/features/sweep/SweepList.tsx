/** The sweeps there are, or of them only the robustness studies. */

import type { Strategy } from "../../api/types";
import { JobList } from "../../jobs/JobList";
import { BATCH } from "../../jobs/useJob";
import { count } from "../../units/format";
import { titleOf } from "./table";

interface Props {
  readonly strategies: readonly Strategy[];
  readonly studies?: boolean;
  readonly current?: string;
}

export function SweepList({ strategies, studies = false, ...rest }: Props) {
  return (
    <JobList
      kind={BATCH}
      title={studies ? "Earlier studies" : "Sweeps"}
      {...(studies && { label: STUDY_LABEL })}
      none={
        studies
          ? "None yet. Choose in the form what is uncertain and start; each study stays here with all its runs."
          : "None yet. Sweep… in the lab’s header runs a scenario over any of its fields; each sweep stays here with all its runs."
      }
      describe={({ label, fields, strategies: swept }) => ({
        title: studies ? count(fields.length, "uncertain field") : titleOf(fields),
        details: [swept.map((id) => strategies.find((strategy) => strategy.id === id)?.label ?? id).join(", ")],
        ...(label === STUDY_LABEL && { page: "/robustness/$id" }),
      })}
      {...rest}
    />
  );
}

/** By this name a sweep is a robustness study. */
export const STUDY_LABEL = "Robustness study";
