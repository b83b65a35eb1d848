/** How the page asks for data and sends changes. */

import { QueryClient } from "@tanstack/react-query";

// A local server needs no network, and asking again is the connection banner's work.
const networkMode = "always";

export const createQueryClient = () =>
  new QueryClient({
    defaultOptions: { queries: { retry: false, networkMode, refetchOnWindowFocus: false }, mutations: { networkMode } },
  });
