/** How many runs a sweep is, and how long they will take. */

import { Text } from "@mantine/core";
import type { Estimate } from "../api/types";
import { formatDuration } from "../units/dates";
import { count } from "../units/format";
import classes from "./sweep.module.css";

interface Props {
  readonly estimate: Estimate | undefined;
  readonly strategies: number;
  /** It is being worked out. */
  readonly pending: boolean;
  /** Something has to be changed first. */
  readonly wrong: boolean;
}

function describe({ total, points, estimated_seconds: seconds, estimated_cost: cost }: Estimate, strategies: number): string {
  const runs = `${count(total, "run")} (${count(points, "point")} × ${count(strategies, "strategy", "strategies")})`;
  return `${runs}, ${seconds === null ? `about ${formatDuration(cost)} of one processor core` : `about ${formatDuration(seconds)}`}`;
}

export function EstimateLine({ estimate, strategies, pending, wrong }: Props) {
  const contradictory = estimate?.contradictory ?? 0;
  return (
    <div className={classes.estimate} role="status" data-testid="estimate">
      <Text size="sm" {...(estimate ? { fw: 600 } : { c: "dimmed" })}>
        {estimate ? describe(estimate, strategies) : wrong ? "Correct the marked fields." : pending ? "Estimating…" : "\u00a0"}
      </Text>
      {estimate?.notes.map((note) => (
        <Text key={note} size="xs" c="dimmed">
          {note}.
        </Text>
      ))}
      {contradictory > 0 && (
        <Text size="xs" c="dimmed">
          In {contradictory === estimate?.total ? "all" : count(contradictory, "run")} of them values contradict each other: these runs fail and say why.
        </Text>
      )}
    </div>
  );
}
