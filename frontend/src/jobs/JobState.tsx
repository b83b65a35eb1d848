/** How far a job is; it can be cancelled. */

import { Button, Group, Progress, Text } from "@mantine/core";
import type { ReactNode } from "react";
import { count } from "../units/format";
import { isFinal } from "./follow";
import ui from "../ui/ui.module.css";
import { useJobCall, type Common, type JobStatus, type JobKind } from "./useJob";
import { Fault, Note } from "../ui/Messages";
import { Card } from "../ui/Card";

interface Props<Item extends Common, Job extends Item> extends Pick<JobStatus<Job>, "connected"> {
  readonly kind: JobKind<Item, Job>;
  readonly job: Job;
  /** In place of the state's own words. */
  readonly texts?: Partial<Record<Common["state"], string>>;
  readonly counts: ReactNode;
  /** Continues one that has ended. */
  readonly resume?: ReactNode;
  readonly readOnly?: boolean;
  /** What it is about. */
  readonly children: ReactNode;
}

const STATE: Readonly<Record<Common["state"], string>> = {
  queued: "Waiting for its turn",
  running: "Running",
  done: "Done",
  cancelled: "Cancelled; finished runs are kept",
  failed: "Failed",
};

/** `12 runs before it`, empty where nothing is. */
export const waitsFor = ({ position }: Pick<Common, "position">) =>
  position > 0 ? `${count(position, "run")} before it` : "";

export function JobState<Item extends Common, Job extends Item>({
  kind,
  job,
  texts,
  counts,
  resume,
  connected,
  readOnly = false,
  children,
}: Props<Item, Job>) {
  const cancel = useJobCall(kind, job.id, () => kind.calls.cancel(job.id));
  const { done, failed, total } = kind.counts(job);
  const ended = isFinal(job);
  const text = [
    texts?.[job.state] ?? STATE[job.state],
    ...(job.state === "queued" && job.position > 0 ? [waitsFor(job)] : []),
  ].join(", ");
  return (
    <Card className={ui.part} aria-label="Progress" data-state={job.state}>
      <Group gap="0.3rem 0.9rem" mih={30}>
        <Text fw={650} role="status" data-testid={`${kind.name}-state`}>
          {text}
          {job.reason !== null && `: ${job.reason}`}
        </Text>
        <Text flex="1 1 12rem" c="dimmed" data-testid={`${kind.name}-counts`}>
          {counts}
        </Text>
        {readOnly ? null : ended ? (
          resume
        ) : (
          <Button loading={cancel.isPending} onClick={() => cancel.mutate(undefined)}>
            Cancel
          </Button>
        )}
      </Group>
      <Progress.Root size={8} transitionDuration={200}>
        <Progress.Section
          value={total === 0 ? 0 : (100 * (done + failed)) / total}
          color={job.state === "failed" ? "red" : job.state === "cancelled" ? "var(--faint)" : "var(--accent)"}
          aria-label={`Finished ${kind.unit}s`}
        />
      </Progress.Root>
      {!connected && !ended && (
        <Note role="status">The connection is interrupted; the numbers are updated when it is back.</Note>
      )}
      {cancel.isError && <Fault>It could not be cancelled: {cancel.error.message}</Fault>}
      {children}
    </Card>
  );
}
