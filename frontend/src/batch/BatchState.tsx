/** How far a sweep is, what it sweeps over, and the way to stop it. */

import { Button, Progress, Text } from "@mantine/core";
import { useMutation, useQueryClient } from "@tanstack/react-query";
import { api } from "../api/client";
import { isFinal } from "../api/follow";
import type { Batch } from "../api/types";
import { otherThanPaper } from "../carried/otherThanPaper";
import type { Group } from "../editor/schema";
import { formatDuration, formatMinute } from "../units/dates";
import { count, formatWhole } from "../units/format";
import classes from "./batch.module.css";
import { batchQuery } from "./useBatch";

interface Props {
  readonly batch: Batch;
  readonly form: Group;
  readonly connected: boolean;
  readonly left: number | null;
  readonly readOnly: boolean;
}

const STATE: Readonly<Record<Batch["state"], string>> = {
  queued: "Waiting for its turn",
  running: "Running",
  done: "Done",
  cancelled: "Cancelled: what had finished stays",
  failed: "Failed",
};

export function BatchState({ batch, form, connected, left, readOnly }: Props) {
  const queries = useQueryClient();
  const cancel = useMutation({
    mutationFn: () => api.cancelBatch(batch.id),
    networkMode: "always",
    onSuccess: (now) => queries.setQueryData(batchQuery(batch.id).queryKey, now),
  });
  const finished = batch.done + batch.failed;
  const percent = batch.total === 0 ? 0 : (100 * finished) / batch.total;
  const ended = isFinal(batch);
  return (
    <section className={classes.state} aria-label="Progress" data-state={batch.state}>
      <div className={classes.stateLine}>
        <Text size="sm" fw={650} role="status" data-testid="batch-state">
          {STATE[batch.state]}
          {batch.reason !== null && `: ${batch.reason}`}
        </Text>
        <Text size="sm" className={classes.counts} data-testid="batch-counts">
          <Counts batch={batch} ended={ended} />
          {left !== null && !ended && ` · about ${formatDuration(left)} left`}
        </Text>
        {!ended && !readOnly && (
          <Button size="xs" variant="default" loading={cancel.isPending} onClick={() => cancel.mutate()}>
            Cancel
          </Button>
        )}
      </div>
      <Progress.Root size={8} transitionDuration={200}>
        <Progress.Section
          value={percent}
          color={batch.state === "failed" ? "red" : batch.state === "cancelled" ? "var(--faint)" : "var(--accent)"}
          aria-label="Finished runs"
        />
      </Progress.Root>
      {!connected && !ended && (
        <Text size="xs" c="dimmed" role="status">
          The connection is interrupted; the numbers go on by themselves when it is back.
        </Text>
      )}
      {cancel.isError && (
        <Text size="xs" className={classes.failed} role="alert">
          It could not be cancelled: {cancel.error.message}
        </Text>
      )}
      <Text size="xs" c="dimmed">
        {facts(batch)}. {otherThanPaper(batch.scenario, form, batch.fields.map(({ name }) => name))}
      </Text>
    </section>
  );
}

/** `1 ok, 2 failed of 3 runs`; `12 of 60 runs finished` where nothing has failed. */
function Counts({ batch, ended }: { readonly batch: Batch; readonly ended: boolean }) {
  const finished = batch.done + batch.failed;
  const failed = <span className={classes.failed}>{formatWhole(batch.failed)} failed</span>;
  if (batch.failed === 0) return `${formatWhole(finished)} of ${count(batch.total, "run")} finished`;
  const whole = finished === batch.total ? ` of ${count(batch.total, "run")}` : "";
  return (
    <>
      {!(ended && whole) && `${formatWhole(finished)} of ${count(batch.total, "run")} finished: `}
      {formatWhole(batch.done)} ok, {failed}
      {ended && whole}
    </>
  );
}

function facts({ created_at: created, started_at: started, finished_at: finished, strategies, total, core_version: version }: Batch): string {
  const points = total / Math.max(1, strategies.length);
  const parts = [
    `${count(points, "point")} × ${count(strategies.length, "strategy", "strategies")}`,
    `submitted ${formatMinute(created)}`,
    ...(started !== null && finished !== null ? [`took ${formatDuration((Date.parse(finished) - Date.parse(started)) / 1000)}`] : []),
    `core ${version}`,
  ];
  return parts.join(" · ");
}
