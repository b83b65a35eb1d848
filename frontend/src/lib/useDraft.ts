/** A form's texts as somebody left them: stored until they are submitted or reset. A tab keeps its own, a new one begins with the last. */

import { useState } from "react";
import { readStored, writeStored } from "./storage";

export interface Draft<Texts> {
  readonly draft: Texts;
  readonly patch: (change: Partial<Texts>) => void;
  /** It is not what the form opens with. */
  readonly isEdited: boolean;
  /** Opens the form anew. */
  readonly reset: () => void;
  /** The next visit begins with a new one, unless it has been edited since, here or in another tab. */
  readonly forget: () => void;
}

interface DraftOptions<Texts> {
  readonly name: "sweep" | "study" | "changed study" | "tuning";
  /** What is changed by it, where that is one of several. */
  readonly of?: string | undefined;
  readonly initial: () => Texts;
  /** A stored draft, `null` where it is none of this form. */
  readonly restore: (stored: unknown) => Texts | null;
}

const keyOf = (name: string) => `ridelab-draft-${name.replace(" ", "-")}`;

/** Undefined where there is none; `null` where the form was opened anew. */
function storedIn(storage: "sessionStorage" | "localStorage", name: string, of: string): unknown {
  const stored = readStored(keyOf(name), storage);
  const isDraft = typeof stored === "object" && stored !== null && "of" in stored && "draft" in stored;
  return isDraft && stored.of === of ? stored.draft : undefined;
}

export function restoreDraft<Texts>({
  name,
  of = "",
  restore,
}: Pick<DraftOptions<Texts>, "name" | "of" | "restore">): Texts | null {
  const own = storedIn("sessionStorage", name, of);
  const draft = (own === undefined ? storedIn("localStorage", name, of) : own) ?? null;
  return draft === null ? null : restore(draft);
}

const isSame = (one: unknown, other: unknown) => JSON.stringify(one) === JSON.stringify(other);

export function useDraft<Texts>({ name, of = "", initial, restore }: DraftOptions<Texts>): Draft<Texts> {
  const [stored, setStored] = useState(() => restoreDraft({ name, of, restore }));
  const [opening, setOpening] = useState(initial);
  const remove = () => {
    writeStored(keyOf(name), { of, draft: null }, "sessionStorage");
    if (isSame(storedIn("localStorage", name, of), stored)) writeStored(keyOf(name), null);
  };
  const draft = stored ?? opening;
  return {
    draft,
    isEdited: stored !== null,
    patch: (change) => {
      const next = { ...draft, ...change };
      setStored(next);
      writeStored(keyOf(name), { of, draft: next }, "sessionStorage");
      writeStored(keyOf(name), { of, draft: next });
    },
    reset: () => {
      remove();
      setStored(null);
      setOpening(initial());
    },
    forget: () => {
      if (isSame(restoreDraft({ name, of, restore }), stored)) remove();
    },
  };
}
