/** The scenario a page beside the dashboard works on: that of the run in the address, or a preset's. */

import { queryOptions, useQuery } from "@tanstack/react-query";
import { useState } from "react";
import { api } from "../api/client";
import type { Preset, Scenario } from "../api/types";
import { presetsQuery, runKey } from "../state/queries";

/** `?run=` or `?preset=`; without either it is the first preset, the paper's. */
export interface Origin {
  readonly run: string | null;
  readonly preset: string | null;
}

export function readOrigin(search: string): Origin {
  const query = new URLSearchParams(search);
  const run = query.get("run");
  return { run, preset: run === null ? query.get("preset") : null };
}

export function formatOrigin({ run, preset }: Origin): string {
  const query = run !== null ? { run } : preset !== null ? { preset } : null;
  return query === null ? "" : `?${new URLSearchParams(query)}`;
}

const runQuery = (id: string | null) =>
  queryOptions({ queryKey: runKey(id ?? ""), queryFn: ({ signal }) => api.run(id ?? "", signal), enabled: id !== null, staleTime: Infinity });

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
  const [origin, setOrigin] = useState(() => readOrigin(window.location.search));
  const presets = useQuery(presetsQuery);
  const run = useQuery(runQuery(origin.run));
  const preset = presets.data?.find(({ id }) => id === origin.preset) ?? presets.data?.[0];
  return {
    origin: origin.run === null ? { run: null, preset: preset?.id ?? origin.preset } : origin,
    scenario: origin.run === null ? preset?.scenario : run.data?.scenario,
    presets: presets.data ?? [],
    error: origin.run === null ? presets.error : run.error,
    choose: (next) => {
      setOrigin(next);
      window.history.replaceState(null, "", window.location.pathname + formatOrigin(next));
    },
  };
}
