/** What every field shares: its value, its error, whether it differs from the paper, and how it is changed. */

import type { JsonValue, Scenario } from "../../api/types";
import { useEdit, useFromScenario, useLab, useReadOnly } from "../../lab/context";
import type { InvalidInput } from "../../lab/labState";
import { useStrategies } from "../../server/useCatalogues";
import { valueAt, type Leaf } from "../../scenario/differences";
import { sameValue, setAt, type Pointer } from "../../scenario/path";
import { optionTitle } from "../../scenario/schema";

export interface LeafState {
  readonly value: JsonValue | undefined;
  readonly readOnly: boolean;
  /** Why the field is not read at the moment; a law of one's own may read any. */
  readonly unread?: string;
  readonly changed: boolean;
  readonly rejected: InvalidInput | undefined;
  readonly error: string | undefined;
  readonly drag: (value: JsonValue) => void;
  readonly release: () => void;
  readonly commit: (value: JsonValue) => void;
  readonly reject: (rejected: InvalidInput) => void;
  readonly clearInvalid: () => void;
}

export function useLeaf({ pointer, paperValue, readWith }: Leaf): LeafState {
  const value = useFromScenario((scenario) => valueAt(scenario, { pointer, paperValue }));
  const isRead = useFromScenario(
    (scenario) => readWith === undefined || valueAt(scenario, { ...readWith, paperValue: null }) === readWith.value,
  );
  const strategies = useStrategies();
  const hasOwnLaw = useLab((state) => strategies.some(({ id, own }) => own && state.strategies.includes(id)));
  const leaf = useValue(pointer, value, (scenario, next) => setAt(scenario, pointer, next));
  const changed = !sameValue(value, paperValue);
  if (readWith === undefined || isRead || hasOwnLaw) return { ...leaf, changed };
  const unread = `Read only with ${readWith.title}: ${optionTitle(readWith.value)}`;
  return { ...leaf, changed, readOnly: true, unread };
}

type Written = (scenario: Scenario, next: JsonValue) => Scenario;

/** A value that is written in a way of its own. */
export function useValue(pointer: Pointer, value: JsonValue | undefined, written: Written): LeafState {
  const rejected = useLab((state) => state.invalidInput[pointer]);
  const refused = useLab((state) => state.serverErrors.fields[pointer]);
  const edit = useEdit();
  return {
    value,
    readOnly: useReadOnly(),
    changed: false,
    rejected,
    error: rejected?.message ?? refused,
    drag: (next) => {
      edit.clearInvalid(pointer);
      edit.drag(written(edit.newest(), next));
    },
    release: () => edit.commit(edit.newest()),
    commit: (next) => {
      edit.clearInvalid(pointer);
      const scenario = written(edit.newest(), next);
      if (!sameValue(scenario, edit.newest())) edit.commit(scenario);
    },
    reject: (next) => edit.reject(pointer, next),
    clearInvalid: () => edit.clearInvalid(pointer),
  };
}
