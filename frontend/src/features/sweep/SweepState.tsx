/** How far a sweep is, and what it sweeps over. */

import { Box, Button } from "@mantine/core";
import { ask } from "../../api/http";
import type { Batch } from "../../api/types";
import { otherThanPaper } from "../scenarioSource/otherThanPaper";
import type { Group } from "../../scenario/schema";
import { isFinal } from "../../jobs/follow";
import { JobState } from "../../jobs/JobState";
import { BATCH, useJobCall } from "../../jobs/useJob";
import { formatDuration, formatMinute } from "../../units/dates";
import { count, formatWhole } from "../../units/format";
import { Fault, Note } from "../../ui/Messages";
import ui from "../../ui/ui.module.css";

interface Props {
  readonly batch: Batch;
  readonly form: Group;
  readonly connected: boolean;
  readonly left: number | null;
  readonly readOnly: boolean;
}

export function BatchState({ batch, form, connected, left, readOnly }: Props) {
  const resume = useJobCall(BATCH, batch.id, () => ask("post", "/batches/{id}/resume", { path: { id: batch.id } }));
  const ended = isFinal(batch);
  const counts = (
    <>
      <Counts batch={batch} ended={ended} />
      {left !== null && !ended && ` · about ${formatDuration(left)} left`}
    </>
  );
  const goOn = batch.state === "cancelled" && (
    <Button loading={resume.isPending} onClick={() => resume.mutate(undefined)}>
      Resume
    </Button>
  );
  return (
    <JobState kind={BATCH} job={batch} {...{ counts, connected, readOnly }} resume={goOn}>
      {resume.isError && <Fault>It could not be resumed: {resume.error.message}</Fault>}
      <Note>
        {facts(batch)}.{" "}
        {otherThanPaper(
          batch.scenario,
          form,
          batch.fields.map(({ name }) => name),
        )}
      </Note>
      {batch.notes.length > 0 && (
        <Box component="ul" m={0} pl="1.1rem" fz="xs" c="dimmed">
          {batch.notes.map((note) => (
            <li key={note}>{note}.</li>
          ))}
        </Box>
      )}
    </JobState>
  );
}

/** `1 ok, 2 failed of 3 runs`; `12 of 60 runs finished` where nothing has failed. */
function Counts({ batch, ended }: { readonly batch: Batch; readonly ended: boolean }) {
  const finished = batch.done + batch.failed;
  const failed = <span className={ui.error}>{formatWhole(batch.failed)} failed</span>;
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

function facts({
  created_at: created,
  started_at: started,
  finished_at: finished,
  strategies,
  total,
  core_version: version,
}: Batch): string {
  const points = total / Math.max(1, strategies.length);
  const parts = [
    `${count(points, "point")} × ${count(strategies.length, "strategy", "strategies")}`,
    `submitted ${formatMinute(created)}`,
    ...(started !== null && finished !== null
      ? [`took ${formatDuration((Date.parse(finished) - Date.parse(started)) / 1000)}`]
      : []),
    `core ${version}`,
  ];
  return parts.join(" · ");
}
