/** What the page asks for; each answer is the same for as long as the server's version is, once all of it is available. */

import { keepPreviousData, queryOptions } from "@tanstack/react-query";
import { api } from "../api/client";
import type { Choices } from "./choices";

const FOR_EVER = { staleTime: Infinity, gcTime: 30 * 60_000 } as const;
/** Rows that are still being computed are asked for again after this [ms]. */
const AGAIN_AFTER = 1_000;
const untilComplete = ({ state }: { readonly state: { readonly data?: { readonly complete: boolean } | undefined } }) =>
  state.data?.complete === false && AGAIN_AFTER;

/** Only the roads concern what the switches do not. */
export const roadsOf = ({ seeds, first_seed }: Choices): Choices => ({ ...(seeds !== undefined && { seeds }), ...(first_seed !== undefined && { first_seed }) });

export const paperQuery = (choices: Choices) =>
  queryOptions({
    queryKey: ["paper", choices],
    queryFn: ({ signal }) => api.paper(choices, signal),
    placeholderData: keepPreviousData,
    refetchInterval: untilComplete,
    ...FOR_EVER,
    staleTime: ({ state }) => (state.data?.unavailable ? 0 : Infinity),
  });

export const effectsQuery = (choices: Choices) =>
  queryOptions({
    queryKey: ["paper readings", roadsOf(choices)],
    queryFn: ({ signal }) => api.paperReadings(roadsOf(choices), signal),
    refetchInterval: untilComplete,
    ...FOR_EVER,
  });

export const attributionQuery = (choices: Choices) =>
  queryOptions({
    queryKey: ["paper attribution", roadsOf(choices)],
    queryFn: ({ signal }) => api.paperAttribution(roadsOf(choices), signal),
    ...FOR_EVER,
  });

export const paperFiguresQuery = (choices: Choices) =>
  queryOptions({
    queryKey: ["paper figures", roadsOf(choices)],
    queryFn: ({ signal }) => api.paperFigures(roadsOf(choices), signal),
    ...FOR_EVER,
  });
