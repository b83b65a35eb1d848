import { queryOptions } from "@tanstack/react-query";
import { batches } from "../api/jobs";

export const defaultsQuery = queryOptions({ queryKey: ["robustness"], queryFn: ({ signal }) => batches.robustness(signal), staleTime: Infinity, gcTime: Infinity });
