/** What a tuning's page gives its cards. */

import type { Trial, Tuning } from "../../api/types";
import type { RunInLab } from "../../ui/useOpenInLab";
import type { Shown } from "./figures";
import type { Point } from "./points";
import type { Tunable } from "./space";

export interface TuningParts {
  readonly tuning: Tuning;
  readonly objectives: readonly Shown[];
  readonly limits: readonly Shown[];
  readonly tunable: Tunable;
  readonly points: readonly Point[];
  /** The tuned strategy's. */
  readonly colour: string;
  readonly load: RunInLab<Trial>;
}
