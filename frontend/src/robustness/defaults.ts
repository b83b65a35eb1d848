import { queryOptions } from "@tanstack/react-query";
import { api } from "../api/client";

export const defaultsQuery = queryOptions({ queryKey: ["robustness"], queryFn: ({ signal }) => api.robustness(signal), staleTime: Infinity, gcTime: Infinity });
