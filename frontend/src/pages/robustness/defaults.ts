import { query } from "../../api/http";

export const defaultsQuery = { ...query("/robustness", {}), staleTime: Infinity, gcTime: Infinity };
