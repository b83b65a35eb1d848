/** The tunings there are, the newest first. */

import { Skeleton, Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import type { Strategy, TuningItem } from "../api/types";
import { isFinal } from "../api/follow";
import type { Figure } from "../batch/figures";
import { formatMinute } from "../units/dates";
import { formatWhole } from "../units/format";
import { ofLimit, ofObjective } from "./figures";
import classes from "./tuner.module.css";
import { tuningsQuery } from "./useTuning";

interface Props {
  readonly strategies: readonly Strategy[];
  readonly figures: readonly Figure[];
}

const REFRESH_MS = 3000;

const STATE: Readonly<Record<TuningItem["state"], string>> = { queued: "waiting", running: "running", done: "done", cancelled: "cancelled", failed: "failed" };

export function Earlier({ strategies, figures }: Props) {
  const { data, error } = useQuery({
    ...tuningsQuery,
    refetchInterval: (query) => query.state.data?.tunings.some((each) => !isFinal(each)) === true && REFRESH_MS,
  });
  return (
    <section className={classes.card} aria-label="Earlier tunings">
      <h2 className={classes.cardTitle}>Earlier tunings</h2>
      {error && !data ? (
        <Text size="sm" role="alert" className={classes.note ?? ""}>
          They could not be read: {error.message}
        </Text>
      ) : !data ? (
        <div className={classes.note} aria-busy aria-label="Loading earlier tunings">
          <Skeleton height={44} radius={6} />
          <Skeleton height={44} radius={6} mt={8} />
        </div>
      ) : data.tunings.length === 0 ? (
        <Text size="sm" c="dimmed" className={classes.note ?? ""}>
          There is none yet. The one you start is listed here and stays, with all its trials.
        </Text>
      ) : (
        <ul className={classes.earlier}>
          {data.tunings.map((tuning) => (
            <li key={tuning.id}>
              <a href={`/tuner/${encodeURIComponent(tuning.id)}`} data-state={tuning.state}>
                <span className={classes.earlierTitle}>{strategies.find(({ id }) => id === tuning.strategy)?.label ?? tuning.strategy}</span>
                <span className={classes.earlierState}>
                  {STATE[tuning.state]}
                  {tuning.state !== "done" && `, ${formatWhole(tuning.trials.done + tuning.trials.failed)} of ${formatWhole(tuning.trials.total)}`}
                </span>
                <span className={classes.earlierText}>{tuning.objectives.map((each) => ofObjective(each, figures).label).join(" · ")}</span>
                {tuning.limits.length > 0 && <span className={classes.earlierText}>within {tuning.limits.map((each) => ofLimit(each, figures).label).join(", ")}</span>}
                <span className={classes.earlierText}>
                  {formatMinute(tuning.created_at)}, {formatWhole(tuning.trials.total)} trials
                </span>
              </a>
            </li>
          ))}
        </ul>
      )}
    </section>
  );
}
