/** A sweep written in the dialog, as a batch to order. */

import { useMemo } from "react";
import { ask } from "../../api/http";
import { withKey } from "../../api/jobs";
import type { Estimate, Scenario } from "../../api/types";
import { BATCH } from "../../jobs/useJob";
import { useJobForm } from "../jobForm/useJobForm";
import { useView } from "../../lab/context";
import { requiredOfThese } from "../../lab/requirements";
import { count } from "../../units/format";
import { readDraft, type SweepDraft } from "./draft";
import type { FieldNameOf } from "../jobForm/problems";

export function useSweep(draft: SweepDraft, scenario: Scenario, onSubmitted: () => void) {
  const { requirements, baseline } = useView();
  const { strategies } = draft;
  const parsed = useMemo(() => readDraft(draft), [draft]);
  return useJobForm({
    kind: "batch",
    body: parsed.ok
      ? { scenario, strategies, sweep: parsed.sweep, ...requiredOfThese(requirements, strategies, baseline) }
      : null,
    errors: parsed.ok ? null : parsed.errors,
    fieldNameOf: sweepFieldName(draft.fields.map(({ field }) => field.name)),
    estimate: (body, signal) => ask("post", "/batches", { body: { ...body, dry_run: true } }, signal),
    onSubmitted,
    submit: async (body, keyOf) => ({
      to: BATCH.page,
      params: { id: (await ask("post", "/batches", { body, ...withKey(keyOf(body)) })).id },
    }),
  });
}

export const amountOf =
  (strategies: number) =>
  ({ total, points }: Estimate) =>
    `${count(total, "run")} (${count(points, "point")} × ${count(strategies, "strategy", "strategies")})`;

export const notesOf = ({ notes, contradictory, total }: Estimate): readonly string[] =>
  contradictory === 0
    ? notes
    : [
        ...notes,
        `In ${contradictory === total ? "all" : count(contradictory, "run")} of them values contradict each other: these runs fail and say why`,
      ];

/** Where the server's errors about a sweep belong. */
export const sweepFieldName =
  (names: readonly string[]): FieldNameOf =>
  ([root, form, ...rest]) => {
    if (root === "strategies") return "strategies";
    if (root !== "sweep") return null;
    const name = form === "grid" ? rest[0] : rest[0] === "ranges" ? rest[1] : rest[0];
    return name !== undefined && (names.includes(name) || name === "samples" || name === "seed") ? name : null;
  };
