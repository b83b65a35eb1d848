/** The studies there are. */

import type { Strategy } from "../api/types";
import { JobList } from "../jobs/JobList";
import { BATCH } from "../jobs/useJob";
import { STUDY_LABEL } from "../jobs/study";

export function EarlierStudies({ strategies }: { readonly strategies: readonly Strategy[] }) {
  return (
    <JobList
      kind={BATCH}
      title="Earlier studies"
      label={STUDY_LABEL}
      none="None yet. Each one you start stays here with all its runs."
      describe={({ fields, strategies: studied }) => ({
        title: `${fields.length} uncertain ${fields.length === 1 ? "field" : "fields"}`,
        details: [studied.map((id) => strategies.find((strategy) => strategy.id === id)?.label ?? id).join(", ")],
        page: "/robustness/$id",
      })}
    />
  );
}
