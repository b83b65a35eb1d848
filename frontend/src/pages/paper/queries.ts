/** What the page asks for; each answer is the same for as long as the server's version is, once all of it is available. */

import { keepPreviousData, queryOptions } from "@tanstack/react-query";
import { ask, query } from "../../api/http";
import type { PaperFigure } from "../../api/types";
import type { Choices } from "./choices";

const UNCHANGING = { staleTime: Infinity, gcTime: 30 * 60_000 } as const;
/** Rows that are still being computed are asked for again after this [ms]. */
const AGAIN_AFTER = 1_000;
const untilComplete = ({ state }: { readonly state: { readonly data?: { readonly complete: boolean } | undefined } }) =>
  state.data?.complete === false && AGAIN_AFTER;

/** Only the roads concern what the switches do not. */
export const roadsOf = ({ seeds, first_seed }: Choices): Choices => ({
  ...(seeds !== undefined && { seeds }),
  ...(first_seed !== undefined && { first_seed }),
});

export const paperQuery = (choices: Choices) => ({
  ...query("/paper", { query: { ...choices, partial: true } }),
  placeholderData: keepPreviousData,
  refetchInterval: untilComplete,
  ...UNCHANGING,
  staleTime: ({ state }: { readonly state: { readonly data?: { readonly unavailable: unknown } | undefined } }) =>
    state.data?.unavailable ? 0 : Infinity,
});

export const effectsQuery = (choices: Choices) => ({
  ...query("/paper/readings", { query: roadsOf(choices) }),
  refetchInterval: untilComplete,
  ...UNCHANGING,
});

export const attributionQuery = (choices: Choices) => ({
  ...query("/paper/attribution", { query: roadsOf(choices) }),
  ...UNCHANGING,
});

export const paperFiguresQuery = (choices: Choices) =>
  queryOptions({
    queryKey: ["paper figures", roadsOf(choices)],
    // plotly's own JSON, which the API's description leaves open
    queryFn: async ({ signal }) =>
      (await ask("get", "/paper/figures", { query: roadsOf(choices) }, signal))
        .figures as unknown as readonly PaperFigure[],
    ...UNCHANGING,
  });
