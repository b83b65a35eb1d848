/** What the lab holds, and what can be done with it. */

import type { QueryClient } from "@tanstack/react-query";
import type { Link, Scenario, StrategyId } from "../api/types";
import type { Pointer } from "../scenario/path";
import type { Group } from "../scenario/schema";
import type { Address } from "./address";
import type { History } from "./history";
import type { Result } from "./result";
import type { Atom, ReadonlyAtom } from "@tanstack/react-store";
import type { Api } from "../api/client";
import type { LabAddress } from "./labAddress";
import type { ErrorsByField } from "../scenario/fields";

/** A text that is not a value the field can take; it stays in its input until somebody changes it. */
export interface InvalidInput {
  readonly text: string;
  readonly message: string;
}

export type Failure =
  | { readonly kind: "notFound" }
  | { readonly kind: "unreachable" }
  | { readonly kind: "failed"; readonly message: string };

export interface LabState {
  readonly history: History<Scenario> | null;
  /** The scenario under a moving slider. */
  readonly drag: Scenario | null;
  readonly invalidInput: Readonly<Record<Pointer, InvalidInput>>;
  readonly serverErrors: ErrorsByField;
  readonly strategies: readonly StrategyId[];
  /** How many roads an exact run drives. */
  readonly roads: number;
  /** What is read: under a moving slider it changes twice a second. */
  readonly shown: Result | null;
  /** The newest exact result: under a moving slider it is no longer what is shown. */
  readonly latestResult: Result | null;
  /** The exact result before the last edit. */
  readonly previousResult: Result | null;
  /** The link this page shows: while there is one, nothing can be edited. */
  readonly shared: Link | null;
  readonly busy: boolean;
  /** What is shown has been older than what was asked for long enough to be noticed. */
  readonly stale: boolean;
  readonly failure: Failure | null;
}

export const hasInvalidInput = ({ invalidInput }: LabState): boolean => Object.keys(invalidInput).length > 0;

export interface Lab extends Pick<Atom<LabState>, "get" | "subscribe"> {
  /** What is drawn: `shown`, under a moving slider the newest answer. */
  readonly newest: ReadonlyAtom<Result | null>;
  /** A panel of this signal is in sight; the end of that is returned. */
  readonly draw: (signal: string) => () => void;
  readonly open: (address: Address) => void;
  /** Opens where Back or Forward led to. */
  readonly navigate: (address: Address) => void;
  readonly openPaper: () => void;
  /** Leaves the shared result: its scenario, run anew and open to edits. */
  readonly openCopy: () => void;
  /** Tells the lab the form (to place errors) and the signals the page draws. */
  readonly configure: (form: Group, signals: readonly string[]) => void;
  readonly drag: (scenario: Scenario) => void;
  readonly commit: (scenario: Scenario) => void;
  readonly reject: (pointer: Pointer, rejected: InvalidInput) => void;
  readonly clearInvalid: (pointer: Pointer) => void;
  /** Takes back the texts that are no values, else the last edit. */
  readonly undo: () => void;
  readonly redo: () => void;
  readonly setStrategies: (strategies: readonly StrategyId[]) => void;
  /** A controller of one's own has changed: what is shown is computed anew, and compared with what was. */
  readonly runAgain: () => void;
  readonly setRoads: (roads: number) => void;
  /** Asks again for what could not be had; does nothing where nothing is missing. */
  readonly resume: () => void;
}

/** Of the server's API what the lab uses. */
export type LabApi = Pick<Api, "createRun" | "run" | "series" | "link" | "live">;

/** What only the loaded form says: where an error belongs, and what the page draws. */
export interface LabForm {
  readonly group: Group | null;
  readonly signals: readonly string[];
}

export interface Services {
  readonly api: LabApi;
  readonly labAddress: LabAddress;
  readonly queries: QueryClient;
}
