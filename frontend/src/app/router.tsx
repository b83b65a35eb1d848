/** Every address of the page and what it shows; each page beside the lab has code of its own, fetched where it is shown. */

import type { QueryClient } from "@tanstack/react-query";
import {
  notFound,
  createRootRouteWithContext,
  createRoute,
  createRouter,
  lazyRouteComponent,
} from "@tanstack/react-router";
import { LabPage } from "../pages/lab/LabPage";
import { readScenarioSource } from "../features/scenarioSource/scenarioSource";
import { readChoices } from "../pages/paper/choices";
import { NothingHere, PageFailed, PageNotFound, Shell, type WayOn } from "./Shell";
import { PageLoading } from "../ui/Page";
import { BATCH, jobQuery, TUNING, type Common, type JobKind } from "../jobs/useJob";
import { endFirstView, firstCurves } from "../lib/firstCurves";
import { uncertaintiesQuery } from "../server/queries";
import { loadCatalogues, loadResultWords } from "../server/useCatalogues";
import { parseSearch, pick, readLabSearch, stringifySearch } from "../lab/address";
import { isNotFound } from "../api/problem";

interface Context {
  readonly queries: QueryClient;
}

const root = createRootRouteWithContext<Context>()({ component: Shell, notFoundComponent: PageNotFound });

// The lab's addresses share one component: it stays when one leads to another.
const lab = createRoute({
  getParentRoute: () => root,
  id: "lab",
  component: LabPage,
  loader: ({ context: { queries } }) => {
    // With the code of what needs them; where they fail, that says so.
    void firstCurves.then(() => loadCatalogues(queries)).catch(() => undefined);
    return loadResultWords(queries);
  },
});
const start = createRoute({ getParentRoute: () => lab, path: "/", validateSearch: readLabSearch });
const run = createRoute({ getParentRoute: () => lab, path: "/r/$id", validateSearch: readLabSearch });
const shared = createRoute({ getParentRoute: () => lab, path: "/s/$id", validateSearch: () => ({}) });

/** Pages beside the lab wait for no curves, but for all styles and all the server's lists. */
const load = ({ context: { queries } }: { readonly context: Context }) => {
  endFirstView();
  return Promise.all([loadCatalogues(queries), import("../ui/mantine.css")]);
};

const loadStudies = ({ context }: { readonly context: Context }) =>
  Promise.all([load({ context }), context.queries.query({ ...uncertaintiesQuery, staleTime: "static" })]);

const notFoundOr = (error: unknown) => {
  if (isNotFound(error)) notFound({ throw: true });
  throw error;
};

/** With the job that the address names; where there is none, the way to others. */
const ofJob = <Item extends Common, Job extends Item>(
  kind: JobKind<Item, Job>,
  what: string,
  wayOn: WayOn,
  loadRest: (route: { readonly context: Context }) => Promise<unknown> = load,
) => ({
  loader: ({ context, params: { id } }: { readonly context: Context; readonly params: { readonly id: string } }) =>
    Promise.all([loadRest({ context }), context.queries.query(jobQuery(kind, id)).catch(notFoundOr)]),
  gcTime: 0, // who comes back later than the job is stored has it fetched again
  notFoundComponent: () => <NothingHere {...{ what, wayOn }} />,
});

const sweep = createRoute({
  getParentRoute: () => root,
  path: "/b/$id",
  ...ofJob(BATCH, "sweep", { to: "/sweeps", label: "All sweeps" }),
  validateSearch: (raw: Record<string, unknown>) =>
    pick(raw, "plot", "x", "y", "hide", "strategy", "against", "at", "versus"),
  component: lazyRouteComponent(() => import("../pages/sweep/SweepPage"), "SweepPage"),
});
const sweeps = createRoute({
  getParentRoute: () => root,
  path: "/sweeps",
  loader: load,
  component: lazyRouteComponent(() => import("../pages/sweep/SweepPage"), "SweepsPage"),
});
const paper = createRoute({
  getParentRoute: () => root,
  path: "/paper",
  loader: load,
  validateSearch: readChoices,
  component: lazyRouteComponent(() => import("../pages/paper/PaperPage"), "PaperPage"),
});
const tuner = createRoute({
  getParentRoute: () => root,
  path: "/tuner",
  loader: load,
  validateSearch: readScenarioSource,
  component: lazyRouteComponent(() => import("../pages/tuner/TunerPage"), "TunerPage"),
});
const tuning = createRoute({
  getParentRoute: () => root,
  path: "/tuner/$id",
  ...ofJob(TUNING, "tuning", { to: "/tuner", label: "New tuning" }),
  component: lazyRouteComponent(() => import("../pages/tuner/TuningPage"), "TuningPage"),
  remountDeps: ({ params }) => params,
});
const robustness = createRoute({
  getParentRoute: () => root,
  path: "/robustness",
  loader: loadStudies,
  validateSearch: readScenarioSource,
  component: lazyRouteComponent(() => import("../pages/robustness/RobustnessPage"), "RobustnessPage"),
});
const study = createRoute({
  getParentRoute: () => root,
  path: "/robustness/$id",
  ...ofJob(BATCH, "study", { to: "/robustness", label: "New study" }, loadStudies),
  validateSearch: (raw: Record<string, unknown>) => pick(raw, "baseline", "one"),
  component: lazyRouteComponent(() => import("../pages/robustness/RobustnessPage"), "StudyPage"),
  remountDeps: ({ params }) => params,
});
const ecu = createRoute({
  getParentRoute: () => root,
  path: "/ecu",
  loader: load,
  validateSearch: readScenarioSource,
  component: lazyRouteComponent(() => import("../pages/ecu/EcuPage"), "EcuPage"),
});

const routeTree = root.addChildren([
  lab.addChildren([start, run, shared]),
  sweep,
  sweeps,
  paper,
  tuner,
  tuning,
  robustness,
  study,
  ecu,
]);

export const createAppRouter = (queries: QueryClient) =>
  createRouter({
    routeTree,
    context: { queries },
    parseSearch,
    stringifySearch,
    scrollRestoration: true,
    defaultPreload: "intent",
    defaultStaleTime: Infinity,
    defaultPendingMs: 100,
    defaultPendingMinMs: 0,
    defaultPendingComponent: PageLoading,
    defaultErrorComponent: PageFailed,
  });

export type AppRouter = ReturnType<typeof createAppRouter>;

declare module "@tanstack/react-router" {
  interface Register {
    router: AppRouter;
  }
}
