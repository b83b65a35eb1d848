/** Undo and redo over whole values. */

import type { JsonValue } from "../api/types";
import { sameValue } from "../scenario/path";

export interface History<T> {
  readonly past: readonly T[];
  readonly present: T;
  readonly future: readonly T[];
}

const DEPTH = 200;

export function begin<T>(present: T): History<T> {
  return { past: [], present, future: [] };
}

/** What equals the present is no step: it would make an undo that changes nothing, and forget what can be done again. */
export function record<T extends JsonValue>(history: History<T>, next: T): History<T> {
  if (sameValue(history.present, next)) return history;
  return { past: [...history.past, history.present].slice(-DEPTH), present: next, future: [] };
}

export function undo<T>(history: History<T>): History<T> {
  const previous = history.past.at(-1);
  if (previous === undefined) return history;
  return { past: history.past.slice(0, -1), present: previous, future: [history.present, ...history.future] };
}

export function redo<T>(history: History<T>): History<T> {
  const [next, ...future] = history.future;
  if (next === undefined) return history;
  return { past: [...history.past, history.present], present: next, future };
}
