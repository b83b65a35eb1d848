/** The pages beside the dashboard, in the order of the navigation; each has code of its own, fetched where it is shown. */

import { lazy, type ComponentType } from "react";

export interface PageProps {
  /** What follows the page's own path, `null` where nothing does. */
  readonly id: string | null;
}

export interface Page {
  /** The first part of its address; backend/api/site.py serves it. */
  readonly path: `/${string}`;
  /** What the navigation calls it. */
  readonly label: string;
  /** It works on a scenario: the run one comes from goes along as `?run=`. */
  readonly takesRun?: true;
  readonly View: ComponentType<PageProps>;
}

/** A component of that name in a module of its own. */
const from = <Name extends string>(name: Name, load: () => Promise<Readonly<Record<Name, ComponentType<PageProps>>>>) =>
  lazy(() => load().then((module) => ({ default: module[name] })));

export const PAGES: readonly Page[] = [
  { path: "/paper", label: "Paper", View: from("PaperPage", () => import("./paper/PaperPage")) },
  { path: "/tuner", label: "Tuner", takesRun: true, View: from("TunerPage", () => import("./tuner/TunerPage")) },
  { path: "/robustness", label: "Robustness", takesRun: true, View: from("RobustnessPage", () => import("./robustness/RobustnessPage")) },
  { path: "/ecu", label: "ECU", takesRun: true, View: from("EcuPage", () => import("./hil/EcuPage")) },
];

/** The page of an address and what follows its path; `null` where the address is another one's. */
export function pageAt(pathname: string): (Page & PageProps) | null {
  const [, first = "", id = ""] = pathname.split("/");
  const page = PAGES.find(({ path }) => path === `/${first}`);
  return page ? { ...page, id: id === "" ? null : id } : null;
}
