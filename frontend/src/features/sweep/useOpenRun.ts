/** From a run of a batch to the lab. */

import { api } from "../../api/client";
import type { Batch, JsonValue } from "../../api/types";
import { useRunInLab, type RunInLab } from "../../ui/openInLab";
import { withFields } from "../../scenario/fields";

export interface RunAtValues {
  readonly run: number;
  /** The swept fields' values. */
  readonly at: Readonly<Record<string, JsonValue>>;
}

export type Opening = RunInLab<RunAtValues>;

export const useOpenRun = ({ scenario, strategies }: Batch): Opening =>
  useRunInLab(({ at }) => api.createRun(withFields(scenario, at), strategies));
