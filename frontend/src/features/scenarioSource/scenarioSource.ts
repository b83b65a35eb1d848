/** The scenario a page beside the lab works on: that of the run in the address, one of the library, or a preset's. */

import { queryOptions, useQuery } from "@tanstack/react-query";
import { useNavigate, useSearch } from "@tanstack/react-router";
import { api } from "../../api/client";
import { ApiProblem } from "../../api/problem";
import type { Preset, Scenario } from "../../api/types";
import { useItems } from "../../scenario/library";
import { pick } from "../../lab/address";
import { runKey } from "../../server/queries";
import { usePresets } from "../../server/useCatalogues";

/** `?run=`, `?own=` or `?preset=`; without any it is the first preset, the paper's. */
export type ScenarioSource = Partial<Record<"run" | "own" | "preset", string>>;

export function readScenarioSource(search: Readonly<Record<string, unknown>>): ScenarioSource {
  const { run, own, preset } = pick(search, "run", "own", "preset");
  if (run !== undefined) return { run };
  if (own !== undefined) return { own };
  return preset === undefined ? {} : { preset };
}

const runQuery = (id: string | undefined) =>
  queryOptions({
    queryKey: runKey(id ?? ""),
    queryFn: ({ signal }) => api.run(id ?? "", signal),
    enabled: id !== undefined,
    staleTime: Infinity,
  });

const NOT_SAVED = new ApiProblem(404, "The library of this browser has no such scenario: choose another", []);

export interface PageScenario {
  readonly origin: ScenarioSource;
  /** `undefined` until it is known. */
  readonly scenario: Scenario | undefined;
  readonly presets: readonly Preset[];
  /** Why there is none. */
  readonly error: Error | null;
  readonly choose: (origin: ScenarioSource) => void;
}

export function usePageScenario(): PageScenario {
  const origin = readScenarioSource(useSearch({ strict: false }));
  const navigate = useNavigate();
  const presets = usePresets();
  const run = useQuery(runQuery(origin.run));
  const preset = presets.find(({ id }) => id === origin.preset) ?? presets[0];
  const own = useItems("scenario").find(({ name }) => name === origin.own);
  const [scenario, error] =
    origin.run !== undefined
      ? [run.data?.scenario, run.error]
      : origin.own !== undefined
        ? [own?.value, own ? null : NOT_SAVED]
        : [preset?.scenario, null];
  return {
    origin: origin.run !== undefined || origin.own !== undefined || !preset ? origin : { preset: preset.id },
    scenario,
    presets,
    error,
    choose: (next) => void navigate({ to: ".", search: next, replace: true, resetScroll: false }),
  };
}
