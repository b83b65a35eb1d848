/** The newest value at once, or, while it changes with every move of a pointer, a few times a second. */

import { useEffect, useEffectEvent, useState } from "react";

/** What is read and not watched needs no more: curves alone follow each answer. */
const CALM_MS = 200;

export function useCalm<Value>(newest: Value, moving: boolean): Value {
  const [calm, setCalm] = useState(newest);
  if (!moving && calm !== newest) setCalm(newest);
  const behind = moving && calm !== newest;
  const catchUp = useEffectEvent(() => setCalm(newest));
  useEffect(() => {
    if (!behind) return undefined;
    const timer = setTimeout(() => catchUp(), CALM_MS);
    return () => clearTimeout(timer);
  }, [behind]);
  return moving ? calm : newest;
}
