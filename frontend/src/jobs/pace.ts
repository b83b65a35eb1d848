/** How long a batch will still take, by how fast it went lately. */

export interface Mark {
  /** [ms] on any clock that does not jump. */
  readonly at: number;
  /** Runs finished by then. */
  readonly finished: number;
}

/** Long enough to even out chunks of about a second, short enough to follow a change of pace [ms]. */
const WINDOW_MS = 20_000;
const LEAST_MS = 1_500;

/** The marks with a new one, without those too old to tell of the pace; one older than the window stays as its start. */
export function withMark(marks: readonly Mark[], mark: Mark): readonly Mark[] {
  const all = [...marks, mark];
  const start = all.findLastIndex(({ at }) => at <= mark.at - WINDOW_MS);
  return all.slice(Math.max(0, start));
}

/** Seconds left, `null` while nobody can know. */
export function secondsLeft(marks: readonly Mark[], total: number): number | null {
  const [first, last] = [marks[0], marks.at(-1)];
  if (!first || !last || last.at - first.at < LEAST_MS || last.finished <= first.finished) return null;
  return ((total - last.finished) * (last.at - first.at)) / (last.finished - first.finished) / 1000;
}
