/** Every address of the page and what it shows; each page beside the lab has code of its own, fetched where it is shown. */

import { createRootRoute, createRoute, createRouter, lazyRouteComponent } from "@tanstack/react-router";
import { LabPage } from "../pages/lab/LabPage";
import { readScenarioSource } from "../features/scenarioSource/scenarioSource";
import { readChoices } from "../pages/paper/choices";
import { PageFailed, PageNotFound } from "./Shell";
import { Shell } from "./Shell";
import { parseSearch, pick, readLabSearch, stringifySearch } from "../lab/address";

const root = createRootRoute({ component: Shell, notFoundComponent: PageNotFound });

// The lab's addresses share one component: it stays when one leads to another.
const lab = createRoute({ getParentRoute: () => root, id: "lab", component: LabPage });
const start = createRoute({ getParentRoute: () => lab, path: "/", validateSearch: readLabSearch });
const run = createRoute({ getParentRoute: () => lab, path: "/r/$id", validateSearch: readLabSearch });
const shared = createRoute({ getParentRoute: () => lab, path: "/s/$id", validateSearch: () => ({}) });

const sweep = createRoute({
  getParentRoute: () => root,
  path: "/b/$id",
  validateSearch: (raw: Record<string, unknown>) =>
    pick(raw, "plot", "x", "y", "hide", "strategy", "against", "at", "versus"),
  component: lazyRouteComponent(() => import("../pages/sweep/SweepPage"), "SweepPage"),
});
const sweeps = createRoute({
  getParentRoute: () => root,
  path: "/sweeps",
  component: lazyRouteComponent(() => import("../pages/sweep/SweepPage"), "SweepsPage"),
});
const paper = createRoute({
  getParentRoute: () => root,
  path: "/paper",
  validateSearch: readChoices,
  component: lazyRouteComponent(() => import("../pages/paper/PaperPage"), "PaperPage"),
});
const tuner = createRoute({
  getParentRoute: () => root,
  path: "/tuner",
  validateSearch: readScenarioSource,
  component: lazyRouteComponent(() => import("../pages/tuner/TunerPage"), "TunerPage"),
});
const tuning = createRoute({
  getParentRoute: () => root,
  path: "/tuner/$id",
  component: lazyRouteComponent(() => import("../pages/tuner/TuningPage"), "TuningPage"),
  remountDeps: ({ params }) => params,
});
const robustness = createRoute({
  getParentRoute: () => root,
  path: "/robustness",
  validateSearch: readScenarioSource,
  component: lazyRouteComponent(() => import("../pages/robustness/RobustnessPage"), "RobustnessPage"),
});
const study = createRoute({
  getParentRoute: () => root,
  path: "/robustness/$id",
  validateSearch: (raw: Record<string, unknown>) => pick(raw, "baseline", "one"),
  component: lazyRouteComponent(() => import("../pages/robustness/StudyPage"), "StudyPage"),
  remountDeps: ({ params }) => params,
});
const ecu = createRoute({
  getParentRoute: () => root,
  path: "/ecu",
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

export const createAppRouter = () =>
  createRouter({
    routeTree,
    parseSearch,
    stringifySearch,
    scrollRestoration: true,
    defaultPreload: "intent",
    defaultErrorComponent: PageFailed,
  });

export type AppRouter = ReturnType<typeof createAppRouter>;

declare module "@tanstack/react-router" {
  interface Register {
    router: AppRouter;
  }
}
