/** A map is not drawn anew under the pointer: what somebody reads stays until they leave it. */

import { useState } from "react";

/** The newest value, or while `hold` the one before, unless another `key` is asked for. */
export function useHeld<Value>(newest: Value, key: string, hold: boolean): Value {
  const [held, setHeld] = useState({ value: newest, key });
  const stays = hold && held.key === key;
  if (!stays && (held.value !== newest || held.key !== key)) setHeld({ value: newest, key });
  return stays ? held.value : newest;
}
