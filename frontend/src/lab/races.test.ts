import { QueryClient } from "@tanstack/react-query";
import { describe, expect, it } from "vitest";
import { ApiProblem } from "../api/problem";
import type { Run, Scenario, StrategyId, Summary } from "../api/types";
import type { AppRouter } from "../app/router";
import { parseSearch, stringifySearch } from "./address";
import type { LabApi, LabState } from "./labState";
import { createLab } from "./lab";
import { createLabAddress } from "./labAddress";

const OPENING = ["lv", "lqr", "passive"];
const wait = () => new Promise((resolve) => setTimeout(resolve, 0));

interface Navigation {
  readonly to: string;
  readonly params?: { readonly id: string };
  readonly search?: Readonly<Record<string, unknown>>;
  readonly replace?: boolean;
  readonly state?: object;
}

type Listener = (change: { readonly location: object; readonly action: object }) => void;

/** A browser's history before the page's routes; one that is `late` changes the address bar only after a while. */
function browser(path: string, late = false) {
  const entries = [path];
  let at = 0;
  const listeners = new Set<Listener>();
  const tell = (type: string, state: object) =>
    listeners.forEach((listener) => listener({ location: { state }, action: { type } }));
  const href = () => entries[at] ?? "";
  const change = ({ to, params, search = {}, replace = false, state = {} }: Navigation) => {
    if (!replace) entries.splice(++at);
    entries[at] = to.replace("$id", params?.id ?? "") + stringifySearch(search);
    tell(replace ? "REPLACE" : "PUSH", state);
  };
  const navigate = (to: Navigation) => {
    if (late) setTimeout(() => change(to));
    else change(to);
  };
  const pages = {
    history: { location: {}, subscribe: (listener: Listener) => listeners.add(listener) },
    parseLocation: () => ({ pathname: href().split("?")[0], search: parseSearch(href().split("?")[1] ?? "") }),
    getMatchedRoutes: (pathname: string) => {
      const [, page = "", id] = pathname.split("/");
      return [
        null,
        id === undefined ? {} : { id },
        { id: page === "" ? "/lab/" : page === "r" ? "/lab/r/$id" : pathname },
      ];
    },
    navigate,
  } as unknown as AppRouter;
  const follow = (to: string) => navigate({ to });
  const back = () => {
    at -= 1;
    tell("BACK", {});
  };
  return { entries, href, follow, back, pages };
}

const summary = {
  status: "ok",
  compute_ms: 1,
  cached: false,
  metrics: {},
  comfort: {},
  events: {},
} as unknown as Summary;
const byStrategy = <T>(ids: readonly StrategyId[], value: T) => Object.fromEntries(ids.map((id) => [id, value]));
const runOf = (scenario: Scenario, ids: readonly StrategyId[]): Run => ({
  id: `h${JSON.stringify(scenario.height ?? 1)}`,
  core_version: "1",
  scenario,
  strategies: byStrategy(ids, summary),
  over: null,
});

/** A lab before a browser and a server whose runs come when a test says so. `h7` is the run of the height 7; over 90 there is none. */
function harness(path: string, initial: Partial<LabState> = {}, late = false) {
  const held: (() => void)[] = [];
  const hold = <T>(value: T, signal: AbortSignal | undefined) =>
    new Promise<T>((resolve, reject) => {
      signal?.addEventListener("abort", () => reject(new DOMException("aborted", "AbortError")));
      held.push(() => resolve(value));
    });
  const api: LabApi = {
    createRun: (scenario, ids, signal) =>
      Number(scenario.height) < 0
        ? Promise.reject(new ApiProblem(422, "refused", []))
        : hold(runOf("height" in scenario ? scenario : { height: 1 }, ids), signal),
    run: (id, signal) =>
      id > "h90"
        ? Promise.reject(new ApiProblem(404, "none", []))
        : hold(runOf({ height: Number(id.slice(1)) }, OPENING), signal),
    series: (_id, ids) => Promise.resolve(byStrategy(ids, {})),
    live: () => new Promise(() => undefined),
    link: () => Promise.reject(new Error("no link here")),
  };
  const { pages, ...page } = browser(path, late);
  const labAddress = createLabAddress(pages);
  const lab = createLab(
    { api, labAddress, queries: new QueryClient({ defaultOptions: { queries: { gcTime: 0 } } }) },
    initial,
  );
  labAddress.onNavigate(lab.navigate);
  const respond = async () => {
    held.at(-1)?.();
    await wait();
  };
  /** What is shown, once everything that was asked for is there. */
  const respondToAll = async () => {
    held.forEach((answer) => answer());
    await wait();
    held.forEach((answer) => answer());
    await wait();
    return { bar: page.href(), shown: lab.get().shown?.runId };
  };
  return { lab, labAddress, ...page, respond, respondToAll };
}

/** A lab with the runs h1 and h2 behind it. */
async function twoRuns() {
  const opened = harness("/");
  await opened.respond();
  opened.lab.commit({ height: 2 });
  await opened.respond();
  return opened;
}

describe("an edit while the run of a link that was followed is loading", () => {
  it("leaves the address with what is shown, when strategies are switched", async () => {
    const { lab, follow, entries, respondToAll } = await twoRuns();
    follow("/r/h7");
    lab.setStrategies(["lqr", "passive"]);
    expect(await respondToAll()).toEqual({ bar: "/r/h2?hide=lv", shown: "h2" });
    expect(entries).toEqual(["/r/h1", "/r/h2", "/r/h7", "/r/h2?hide=lv"]);
  });

  it("leaves the address with what is shown, under a moving slider", async () => {
    const { lab, follow, href, respondToAll } = await twoRuns();
    follow("/r/h7");
    lab.drag({ height: 3 });
    expect(href()).toBe("/r/h2");
    lab.commit({ height: 3 });
    expect(await respondToAll()).toEqual({ bar: "/r/h3", shown: "h3" });
  });

  it("leaves the address with what is shown, when it is refused", async () => {
    const { lab, follow, respondToAll } = await twoRuns();
    follow("/r/h7");
    lab.commit({ height: -1 });
    expect(await respondToAll()).toEqual({ bar: "/r/h2", shown: "h2" });
  });
});

it("Nothing is shown under an address with no run, and a strategy asks for one again", async () => {
  const { lab, follow, respondToAll } = await twoRuns();
  follow("/r/h99");
  expect(await respondToAll()).toEqual({ bar: "/r/h99", shown: undefined });
  lab.setStrategies(["lqr", "passive"]);
  expect(await respondToAll()).toEqual({ bar: "/r/h2", shown: "h2" });
});

it("The paper's scenario leads back to no page; an edit and other strategies of an opened run do", async () => {
  const { lab, respondToAll } = harness("/r/h7?from=/paper");
  await respondToAll();
  lab.setStrategies([...OPENING, "speed_only"]);
  expect((await respondToAll()).bar).toBe("/r/h7?from=/paper");
  lab.commit({ height: 9 });
  expect((await respondToAll()).bar).toBe("/r/h9?from=/paper");
  const other = harness("/r/h7?from=/paper");
  await other.respondToAll();
  other.lab.openPaper();
  expect((await other.respondToAll()).bar).toBe("/r/h1");
});

it("A run that is merely opened has no state before the last edit", async () => {
  const { lab, follow, respondToAll } = await twoRuns();
  expect(lab.get().previousResult?.runId).toBe("h1");
  follow("/r/h7");
  await respondToAll();
  expect(lab.get()).toMatchObject({ shown: { runId: "h7" }, previousResult: null });
});

it("A run of the same scenario that is opened is no step to undo", async () => {
  const { lab, follow, respondToAll } = await twoRuns();
  lab.undo();
  await respondToAll();
  const { history } = lab.get();
  follow("/r/h1?axis=time");
  await respondToAll();
  expect(lab.get()).toMatchObject({
    shown: { runId: "h1" },
    history: { past: [], present: { height: 1 }, future: [{ height: 2 }] },
  });
  lab.commit({ height: 1 });
  expect(lab.get().history).toEqual(history);
});

it("What the lab itself writes into the address bar is no link that was followed, however late it stands there", async () => {
  const { lab, labAddress, respond, href, entries } = harness("/", {}, true);
  await respond();
  await wait();
  expect(href()).toBe("/r/h1");
  labAddress.setView({ axis: "time" });
  labAddress.setView({ baseline: "lqr" });
  await wait();
  expect(lab.get()).toMatchObject({ busy: false, stale: false });
  expect(labAddress.get().view).toMatchObject({ axis: "time", baseline: "lqr" });
  expect([href(), entries.length]).toEqual(["/r/h1?axis=time&baseline=lqr", 1]);
});

it("Nothing is stale where Back leads to no run and no strategy is selected", async () => {
  const { lab, follow, back, respondToAll } = harness("/?axis=time");
  follow("/?baseline=lqr");
  follow("/r/h7");
  await respondToAll();
  lab.setStrategies([]);
  back();
  expect(lab.get()).toMatchObject({ busy: false, stale: false, strategies: [] });
});
