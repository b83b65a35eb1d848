/** What a study's page gives its cards. */

import type { Batch, BatchSummary, Strategy } from "../../api/types";
import type { Figure } from "../../server/metrics";
import type { Opening } from "../../features/sweep/useOpenRun";

export interface StudyParts {
  readonly batch: Batch;
  readonly summary: BatchSummary;
  /** The study's, in the catalogue's order. */
  readonly strategies: readonly Strategy[];
  readonly figures: readonly Figure[];
  readonly opening: Opening;
}
