/** The sweeps there are; robustness studies are among them. */

import type { Strategy } from "../api/types";
import { JobList } from "../jobs/JobList";
import { STUDY_LABEL } from "../jobs/study";
import { BATCH } from "../jobs/useJob";
import { titleOf } from "./title";

interface Props {
  readonly strategies: readonly Strategy[];
  readonly current?: string;
}

export function SweepList({ strategies, ...rest }: Props) {
  return (
    <JobList
      kind={BATCH}
      title="Sweeps"
      none="None yet. Each one you start stays here with all its runs."
      describe={({ label, fields, strategies: swept }) => ({
        title: titleOf(fields),
        details: [swept.map((id) => strategies.find((strategy) => strategy.id === id)?.label ?? id).join(", ")],
        ...(label === STUDY_LABEL && { page: "/robustness/$id" }),
      })}
      {...rest}
    />
  );
}
