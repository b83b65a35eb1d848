/** The scenario a page beside the lab works on: that of the run in the address, or a preset's. */

import { queryOptions, useQuery } from "@tanstack/react-query";
import { useNavigate, useSearch } from "@tanstack/react-router";
import { api } from "../api/client";
import type { Preset, Scenario } from "../api/types";
import { pick } from "../state/address";
import { presetsQuery, runKey } from "../state/queries";

/** `?run=` or `?preset=`; without either it is the first preset, the paper's. */
export type Origin = Partial<Record<"run" | "preset", string>>;

export function readOrigin(search: Readonly<Record<string, unknown>>): Origin {
  const { run, preset } = pick(search, "run", "preset");
  return run !== undefined ? { run } : preset !== undefined ? { preset } : {};
}

const runQuery = (id: string | undefined) =>
  queryOptions({ queryKey: runKey(id ?? ""), queryFn: ({ signal }) => api.run(id ?? "", signal), enabled: id !== undefined, staleTime: Infinity });

export interface PageScenario {
  readonly origin: Origin;
  /** `undefined` until it is known. */
  readonly scenario: Scenario | undefined;
  readonly presets: readonly Preset[];
  /** Why there is none. */
  readonly error: Error | null;
  readonly choose: (origin: Origin) => void;
}

export function usePageScenario(): PageScenario {
  const origin = readOrigin(useSearch({ strict: false }));
  const navigate = useNavigate();
  const presets = useQuery(presetsQuery);
  const run = useQuery(runQuery(origin.run));
  const preset = presets.data?.find(({ id }) => id === origin.preset) ?? presets.data?.[0];
  const isRun = origin.run !== undefined;
  return {
    origin: isRun || !preset ? origin : { preset: preset.id },
    scenario: isRun ? run.data?.scenario : preset?.scenario,
    presets: presets.data ?? [],
    error: isRun ? run.error : presets.error,
    choose: (next) => void navigate({ to: ".", search: next, replace: true, resetScroll: false }),
  };
}
