/** What every field shares: its value, its error, whether it differs from the paper, and how it is changed. */

import { useEffect, useEffectEvent, useRef } from "react";
import type { JsonValue } from "../../api/types";
import { useEdit, useFromScenario, useLab, useReadOnly } from "../../lab/context";
import type { InvalidInput } from "../../lab/labState";
import { valueAt } from "../../scenario/differences";
import { getAt, sameValue, setAt, type Pointer } from "../../scenario/path";
import { createTimer } from "../../lib/timer";

export interface LeafState {
  readonly value: JsonValue | undefined;
  readonly readOnly: boolean;
  readonly changed: boolean;
  readonly rejected: InvalidInput | undefined;
  readonly error: string | undefined;
  readonly drag: (value: JsonValue) => void;
  readonly release: () => void;
  readonly commit: (value: JsonValue) => void;
  readonly reject: (rejected: InvalidInput) => void;
  readonly accept: () => void;
}

export function useLeaf(pointer: Pointer, standard: JsonValue): LeafState {
  const value = useFromScenario((scenario) => valueAt(scenario, { pointer, paperValue: standard }));
  const rejected = useLab((state) => state.invalidInput[pointer]);
  const refused = useLab((state) => state.serverErrors.fields[pointer]);
  const edit = useEdit();
  const readOnly = useReadOnly();
  return {
    value,
    readOnly,
    changed: !sameValue(value, standard),
    rejected,
    error: rejected?.message ?? refused,
    drag: (next) => {
      edit.accept(pointer);
      edit.drag(setAt(edit.newest(), pointer, next));
    },
    release: () => edit.commit(edit.newest()),
    commit: (next) => {
      edit.accept(pointer);
      if (!sameValue(getAt(edit.newest(), pointer), next)) edit.commit(setAt(edit.newest(), pointer, next));
    },
    reject: (next) => edit.reject(pointer, next),
    accept: () => edit.accept(pointer),
  };
}

const KEY_PAUSE_MS = 350;

/** Changes made with keys, which have no release of their own: a pause ends them, and so does leaving the control. */
export function useReleaseAfterKeys(release: () => void) {
  const timer = useRef<ReturnType<typeof createTimer>>(null);
  const end = useEffectEvent(() => release());
  useEffect(() => {
    const own = createTimer(KEY_PAUSE_MS, () => end());
    timer.current = own;
    return own.flush;
  }, []);
  return {
    begin: () => timer.current?.start(),
    stop: () => timer.current?.stop(),
    flush: () => timer.current?.flush(),
  };
}
