/** The sweeps there are; robustness studies are among them. */

import type { Strategy } from "../api/types";
import { JobList } from "../jobs/JobList";
import { BATCH } from "../jobs/useJob";

interface Props {
  readonly strategies: readonly Strategy[];
  readonly current?: string;
}

export const titleOf = (fields: readonly { readonly title: string }[]) => fields.map(({ title }) => title).join(" × ") || "The scenario alone";

export function SweepList({ strategies, ...rest }: Props) {
  return (
    <JobList
      kind={BATCH}
      title="Sweeps"
      none="None yet. Each one you start stays here with all its runs."
      describe={({ fields, strategies: swept }) => ({
        title: titleOf(fields),
        details: [swept.map((id) => strategies.find((strategy) => strategy.id === id)?.label ?? id).join(", ")],
      })}
      {...rest}
    />
  );
}
