/** Dates as a person reads them, without a doubt which number is the month. */

const DATE = { day: "numeric", month: "short", year: "numeric" } as const;
const DAY = new Intl.DateTimeFormat("en-GB", DATE);
const MINUTE = new Intl.DateTimeFormat("en-GB", { ...DATE, hour: "2-digit", minute: "2-digit" });

export const formatDay = (iso: string) => DAY.format(new Date(iso));

export const formatMinute = (iso: string) => MINUTE.format(new Date(iso));

/** `a few seconds`, `40 s`, `3 min`, `2.5 h`: as exact as an estimate deserves. */
export function formatDuration(seconds: number): string {
  if (seconds < 2) return "a second or two";
  if (seconds < 90) return `${Math.round(seconds)} s`;
  const minutes = seconds / 60;
  if (minutes < 90) return `${Math.round(minutes)} min`;
  return `${(minutes / 60).toFixed(1)} h`;
}
