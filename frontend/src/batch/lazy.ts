import { lazy } from "react";

/** The page of a sweep; its code is fetched only where it is shown. */
export const LazyBatchPage = lazy(() => import("./BatchPage").then((module) => ({ default: module.BatchPage })));
