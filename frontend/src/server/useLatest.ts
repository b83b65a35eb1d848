/** What the server says of something that changes faster than it answers. */

import { useEffect, useState } from "react";
import { isTransient } from "../api/problem";
import { createLatest } from "../lib/latest";

/** One question at a time; what was overtaken is not shown. `ask` depends on its input alone. */
export function useLatest<Input, Answer>(ask: (input: Input, signal: AbortSignal) => Promise<Answer>) {
  const [shown, setShown] = useState<{
    /** The last there was. */
    readonly answer: Answer | null;
    /** Why the newest question has none. */
    readonly error: Error | null;
  }>({ answer: null, error: null });
  const [latest] = useState(() =>
    createLatest<Input, Answer>({
      run: ask,
      onAnswer: (answer) => setShown({ answer, error: null }),
      onError: (error) => {
        if (error instanceof Error && !isTransient(error)) setShown(({ answer }) => ({ answer, error }));
      },
    }),
  );
  useEffect(() => latest.cancel, [latest]);
  return { ...shown, ...latest };
}
