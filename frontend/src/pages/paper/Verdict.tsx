/** A verdict as icon and word, and a count of the three as a bar. Colour only repeats them. */

import { Box, Group, Progress } from "@mantine/core";
import { Icon } from "../../ui/icons";
import type { PaperJudgement, VerdictCounts, Paper, PaperCell, PaperVerdict } from "../../api/types";
import { count } from "../../units/format";
import ui from "../../ui/ui.module.css";

const ICONS = {
  reached: "Check",
  smaller: "ArrowDownRight",
  contradicts: "X",
  unavailable: "Minus",
  pending: "Dots",
} as const;

/** `certain`: the whole interval would get it. */
export function VerdictMark({ verdict, certain }: Pick<PaperJudgement, "verdict" | "certain">) {
  return (
    <span className={ui.mark} data-verdict={verdict}>
      <Icon name={ICONS[verdict]} size={14} stroke={2.6} />
      <span>
        {wordOf(verdict)}
        {certain === false && (
          <Box
            component="span"
            fz="xs"
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
  return (
    <Progress.Root size={large ? 16 : 8} role="img" aria-label={countsInWords(counts)}>
      {VERDICTS.filter(({ verdict }) => counts[verdict] > 0).map(({ verdict, colour }) => (
        <Progress.Section
          key={verdict}
          withAria={false}
          data-verdict={verdict}
          value={(100 * counts[verdict]) / Math.max(1, total)}
          color={colour}
          style={PART}
        />
      ))}
    </Progress.Root>
  );
}

/** Told apart without colours too, however small. */
const PART = { minWidth: 5, borderRight: "2px solid var(--surface)", printColorAdjust: "exact" } as const;

export function VerdictCountList({ counts }: { readonly counts: VerdictCounts }) {
  return (
    <Group component="ul" className={ui.list ?? ""} gap="0.2rem 0.7rem" fz="sm">
      {VERDICTS.map(({ verdict }) => (
        <li key={verdict} className={ui.mark} data-verdict={verdict}>
          <Icon name={ICONS[verdict]} size={14} stroke={2.6} />
          <span>
            <b>{counts[verdict]}</b> {verdict}
          </span>
        </li>
      ))}
    </Group>
  );
}

/** From the best to the worst; words as the tables have them. */
export const VERDICTS: readonly { readonly verdict: PaperVerdict; readonly colour: string }[] = [
  { verdict: "reached", colour: "var(--better)" },
  { verdict: "smaller", colour: "var(--faint)" },
  { verdict: "contradicts", colour: "var(--worse)" },
];

export const wordOf = (verdict: PaperJudgement["verdict"]) => (verdict === "unavailable" ? "not available" : verdict);

/** What a count is of: while some are pending, of all cells. */
export const countedOf = ({ complete, cells }: Pick<Paper, "complete" | "cells">, counts: VerdictCounts) =>
  complete ? totalOf(counts) : cells.length;

/** Behind a count that is not the last one. */
export const soFar = ({ complete }: Pick<Paper, "complete">) => (complete ? "" : " so far");

const totalOf = (counts: VerdictCounts) => VERDICTS.reduce((sum, { verdict }) => sum + counts[verdict], 0);

/** `28 reached, 8 smaller, 4 contradicts`. */
export const countsInWords = (counts: VerdictCounts) =>
  VERDICTS.map(({ verdict }) => `${counts[verdict]} ${verdict}`).join(", ");

/** Where a cell stands on the page. */
export const cellId = ({
  table,
  strategy,
  against,
  signal,
}: Pick<PaperCell, "table" | "strategy" | "against" | "signal">) => `table-${table}-${strategy}-${against}-${signal}`;

const turned = ({ cells }: Paper) =>
  cells.filter(({ verdict, without_preview: without }) => without !== null && without.verdict !== verdict).length;

/** What the whole claim hinges on: preview, in one sentence made from the counts. */
export function previewSentence(paper: Paper): string {
  const { reached, total, without_preview: without, readings } = paper;
  const preview = readings.find(({ id }) => id === "preview");
  const choice = preview?.choices.find(({ id }) => id === preview.chosen);
  if (!choice || choice.id === "none")
    return "These are already the cells without preview: no controller knows the road ahead.";
  const same = `With preview (${choice.label.toLowerCase()}) ${reached} of ${total} cells are reached, without it ${without.reached}: `;
  const fewer = reached - without.reached;
  if (fewer <= 0) return `${same}here the claim does not hinge on preview.`;
  return `${same}the claim hinges on what the controller knows of the road ahead. Without it ${count(turned(paper), "verdict")} ${turned(paper) === 1 ? "changes" : "change"}.`;
}

/** In how many cells the interval leaves the verdict open. */
export const uncertain = ({ cells }: Paper) => cells.filter(({ certain }) => certain === false).length;

export const isMissed = ({ verdict }: PaperCell) => verdict === "smaller" || verdict === "contradicts";

/** `28 of 40`. */
export function Of({ reached, total }: Record<"reached" | "total", number>) {
  if (total === 0) return "–";
  return (
    <>
      <b>{reached}</b> of {total}
    </>
  );
}
