/** A verdict as icon and word, and a count of the three as a bar. Colour only repeats them. */

import { Box } from "@mantine/core";
import { IconArrowDownRight, IconCheck, IconDots, IconMinus, IconX } from "../../ui/icons";
import type { PaperJudgement, VerdictCounts } from "../../api/types";
import classes from "./verdict.module.css";
import { countsInWords, totalOf, VERDICTS, wordOf } from "./verdicts";

const ICONS = {
  reached: IconCheck,
  smaller: IconArrowDownRight,
  contradicts: IconX,
  unavailable: IconMinus,
  pending: IconDots,
} as const;

/** `certain`: the whole interval would get it. */
export function VerdictMark({ verdict, certain }: Pick<PaperJudgement, "verdict" | "certain">) {
  const Icon = ICONS[verdict];
  return (
    <span className={classes.mark} data-verdict={verdict}>
      <Icon size={14} stroke={2.6} aria-hidden />
      <span>
        {wordOf(verdict)}
        {certain === false && (
          <Box
            component="span"
            fz="0.6875rem"
            fw={400}
            c="dimmed"
            title="A part of the 95 % interval would get another verdict"
          >
            {" "}
            uncertain
          </Box>
        )}
      </span>
    </span>
  );
}

interface BarProps {
  readonly counts: VerdictCounts;
  /** What is counted; without it all have a verdict. */
  readonly total?: number;
  readonly large?: boolean;
}

export function VerdictBar({ counts, total = totalOf(counts), large = false }: BarProps) {
  const pending = total - totalOf(counts);
  return (
    <div className={classes.bar} data-large={large || undefined} role="img" aria-label={countsInWords(counts)}>
      {VERDICTS.filter(({ verdict }) => counts[verdict] > 0).map(({ verdict }) => (
        <span key={verdict} data-verdict={verdict} style={{ flexGrow: counts[verdict] / Math.max(1, total) }} />
      ))}
      {pending > 0 && <span data-verdict="pending" style={{ flexGrow: pending / total }} />}
    </div>
  );
}

export function VerdictCountList({ counts }: { readonly counts: VerdictCounts }) {
  return (
    <ul className={classes.counts}>
      {VERDICTS.map(({ verdict, word }) => {
        const Icon = ICONS[verdict];
        return (
          <li key={verdict} className={classes.mark} data-verdict={verdict}>
            <Icon size={14} stroke={2.6} aria-hidden />
            <span>
              <b>{counts[verdict]}</b> {word}
            </span>
          </li>
        );
      })}
    </ul>
  );
}
