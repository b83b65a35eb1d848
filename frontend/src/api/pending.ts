/** Shapes of links and batches. */

import type { Run, Scenario, StrategyId } from "./types";

/** How a shared result is looked at; every part may be missing. */
export interface SharedView {
  readonly strategies?: readonly StrategyId[] | null;
  readonly hidden?: readonly StrategyId[] | null;
  readonly baseline?: StrategyId | null;
  readonly axis?: "distance" | "time" | null;
  readonly zoom?: readonly number[] | null;
  readonly cursor?: number | null;
  /** Of a batch: the swept field and the metric of its plot. */
  readonly x?: string | null;
  readonly y?: string | null;
}

export interface NewLink {
  readonly slug: string;
  /** Absolute path, `/s/{slug}`. */
  readonly url: string;
}

export interface Link extends NewLink {
  readonly created_at: string;
  readonly kind: "run" | "batch";
  readonly core_version: string;
  readonly current_core_version: string;
  readonly scenario: Scenario;
  readonly view: SharedView;
  readonly run: Run | null;
  readonly batch: Batch | null;
  readonly series_pinned: boolean;
}

export type BatchState = "queued" | "running" | "done" | "cancelled" | "failed";

export interface SweptField {
  readonly name: string;
  readonly title: string;
  readonly unit: string;
}

export interface Batch {
  readonly id: string;
  readonly state: BatchState;
  readonly reason: string | null;
  readonly total: number;
  /** Runs that succeeded. */
  readonly done: number;
  readonly failed: number;
  readonly core_version: string;
  readonly scenario: Scenario;
  readonly strategies: readonly StrategyId[];
  readonly fields: readonly SweptField[];
  readonly estimated_cost: number;
  readonly created_at: string;
  readonly started_at: string | null;
  readonly finished_at: string | null;
}
