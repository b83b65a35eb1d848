/** How many of the paper's printed changes come out here, and what that hinges on. */

import { Anchor, Box, Button, Group, Progress, Stack, Text } from "@mantine/core";
import type { ComponentProps } from "react";
import { Icon } from "../../ui/icons";
import { api } from "../../api/client";
import type { Paper, PaperCell, PaperInterpretation, VerdictCounts } from "../../api/types";
import { useRunInLab } from "../../ui/openInLab";
import { count, formatWhole } from "../../units/format";
import classes from "./paper.module.css";
import {
  Of,
  VerdictBar,
  VerdictCountList,
  VerdictMark,
  cellId,
  countedOf,
  isMissed,
  previewSentence,
  soFar,
  uncertain,
} from "./Verdict";
import { useChoices, withSet } from "./choices";
import { typeset } from "./numbers";
import { useLabels, type Labels } from "../../server/useCatalogues";
import { Fault } from "../../ui/Messages";
import { Columns } from "../../ui/Card";
import ui from "../../ui/ui.module.css";
import { DataTable, type Column } from "../../ui/DataTable";

interface Props {
  readonly paper: Paper;
}

export function CountSection({ paper }: Props) {
  const { unavailable } = paper;
  return (
    <>
      <Runs paper={paper} />
      <Columns className={ui.whole ?? ""} least="22rem" gap="0.8rem">
        <Counted paper={paper} counts={paper.counts} data-testid="count">
          <BigNumber>{paper.reached}</BigNumber> of {countedOf(paper, paper.counts)} cells reached{soFar(paper)}
          {unavailable && ", "}
          {unavailable && <span>{unavailable.cells} not available here</span>}
        </Counted>
        <Counted paper={paper} counts={paper.without_preview.counts} data-testid="count-without" data-aside>
          <Icon name="EyeOff" size={18} stroke={1.8} style={MUTED} />
          <span>
            Without preview: <BigNumber>{paper.without_preview.reached}</BigNumber> of{" "}
            {countedOf(paper, paper.without_preview.counts)}
            {soFar(paper)}
          </span>
        </Counted>
      </Columns>
      {unavailable && (
        <Group gap="0.5rem" align="flex-start" wrap="nowrap" maw="52rem" mt="0.9rem" lh="1.5" data-testid="unavailable">
          <Icon name="AlertTriangle" size={16} stroke={1.8} style={MUTED} />
          <span>
            The {unavailable.cells} cells of hardware in the loop are not available here and not counted.{" "}
            {typeset(unavailable.reason)}.
          </span>
        </Group>
      )}
      <Text className={classes.claim}>
        {paper.complete ? previewSentence(paper) : "This says what the claim hinges on when all runs are finished."}
      </Text>
      <Interpretations paper={paper} />
      <Text maw="52rem" m="0.4rem 0 0.9rem" fz="sm" lh="1.5" c="dimmed">
        Two named sets of readings, on the same roads. A cell is reached by its direction and size; nearer than that,
        “within ±10 points” counts the simulated changes that lie so near to the printed one, “in our interval” those
        whose printed change lies in our 95&nbsp;% interval.
      </Text>
      <Text className={ui.lead ?? ""} mb="0.6rem">
        A cell is one change the paper prints in Tables 4–5 and 7–10. Ours is the change of the means over{" "}
        {count(paper.seeds, "road")} of class B (seeds {paper.first_seed} to {paper.first_seed + paper.seeds - 1}), the
        same for every strategy, with its 95 % interval; computed by core {paper.core_version}.{" "}
        {(uncertain(paper) > 0 || !paper.complete) &&
          `In ${count(uncertain(paper), "cell")} the interval leaves the verdict open (“uncertain”). `}
        <Anchor href="#rules">The rules</Anchor> were fixed before any number.
      </Text>
      <OpenScenario paper={paper} />
      <Missed paper={paper} />
    </>
  );
}

interface CountedProps extends Props, ComponentProps<typeof Stack> {
  readonly counts: VerdictCounts;
}

/** A count in large, as a bar and as a list. */
function Counted({ paper, counts, children, ...rest }: CountedProps) {
  return (
    <Stack className={ui.card ?? ""} gap="0.6rem" p="0.9rem 1.1rem" {...rest}>
      <Group component="p" gap="0.4rem" align="baseline" m={0} fz="lg">
        {children}
      </Group>
      <VerdictBar counts={counts} total={countedOf(paper, counts)} large />
      <VerdictCountList counts={counts} />
    </Stack>
  );
}

const MUTED = { flex: "none", alignSelf: "center", color: "var(--muted)" };

const BigNumber = ({ children }: { readonly children: number }) => (
  <Box component="strong" fz="xl" fw={700} lh={1.1}>
    {children}
  </Box>
);

/** How many runs the cells are made of are finished; one line, before and after. */
function Runs({ paper: { complete, progress } }: Props) {
  return (
    <Group gap="0.8rem" mb="0.5rem" wrap="nowrap">
      <Text c="dimmed" data-testid="progress">
        {complete
          ? `Computed from ${count(progress.done, "run")}.`
          : `${formatWhole(progress.done)} of ${count(progress.total, "run")}`}
      </Text>
      {!complete && (
        <Progress
          size={6}
          value={(100 * progress.done) / Math.max(1, progress.total)}
          color="var(--accent)"
          aria-label="Finished runs"
          flex="0 1 20rem"
        />
      )}
    </Group>
  );
}

/** Runs the page's scenario as the lab would and goes there. */
function OpenScenario({ paper }: Props) {
  const strategies = [
    ...new Set(paper.tables.flatMap(({ columns }) => columns.flatMap(({ strategy, against }) => [strategy, against]))),
  ];
  const { open, opening, error } = useRunInLab((all: readonly string[]) => api.createRun(paper.scenario, all));
  return (
    <Group gap="0.6rem" m="0.2rem 0 0.8rem" data-unprinted>
      <Button
        rightSection={<Icon name="ArrowRight" size={15} />}
        loading={opening !== null}
        onClick={() => open(strategies)}
      >
        Open this scenario in the lab
      </Button>
      {error !== null && <Fault size="md">{error}</Fault>}
    </Group>
  );
}

function Missed({ paper }: Props) {
  const words = useLabels();
  const missed = paper.cells.filter(isMissed);
  if (missed.length === 0 && paper.complete) return null;
  return (
    <Box component="details" className={`${ui.card} ${ui.more}`} p="0.5rem 0.9rem">
      <summary>
        {paper.complete
          ? `${missed.length === 1 ? "The cell" : `The ${missed.length} cells`} not reached`
          : `${count(missed.length, "cell")} not reached so far`}
      </summary>
      <Stack component="ul" className={ui.list ?? ""} gap="0.35rem" py="0.2rem" fz="sm">
        {[...missed]
          .sort((a, b) => a.verdict.localeCompare(b.verdict) || a.table - b.table)
          .map((cell) => (
            <Group component="li" key={cellId(cell)} gap="0 0.6rem">
              <Box component="span" w="7rem">
                <VerdictMark verdict={cell.verdict} certain={cell.certain} />
              </Box>
              <Anchor href={`#${cellId(cell)}`} fz="sm">
                {cellName(cell, words)}
              </Anchor>
            </Group>
          ))}
      </Stack>
      <Box component="p" m="0.4rem 0 0" c="dimmed">
        Why each does not come out is in <code>docs/explanation/paper.md</code>, beside this program’s source, under
        “What does not reproduce, and why”.
      </Box>
    </Box>
  );
}

const cellName = ({ table, strategy, against, signal }: PaperCell, words: Labels) =>
  `Table ${table}, ${words.signal(signal).toLowerCase()}: ${words.strategy(strategy)} against ${words.strategy(against)}`;

function Interpretations({ paper }: Props) {
  const [choices, choose] = useChoices();
  return (
    <DataTable
      label="Interpretations"
      card
      attributes={{ "data-testid": "interpretations" }}
      rows={paper.interpretations}
      rowKey={({ id }) => id}
      rowAttributes={({ id }) => ({
        "data-interpretation": id,
        "aria-current": id === paper.interpretation || undefined,
      })}
      columns={columnsOf(paper, (id) => choose(withSet(choices, paper.readings, id)))}
    />
  );
}

function columnsOf(paper: Paper, onShow: (id: string) => void): readonly Column<PaperInterpretation>[] {
  return [
    {
      key: "interpretation",
      head: "Interpretation",
      text: true,
      cell: ({ title, description }) => (
        <Box miw="7rem" maw="30rem">
          <b>{title}</b>
          <span className={ui.under}>{typeset(description)}</span>
        </Box>
      ),
    },
    { key: "reached", head: "Reached", cell: ({ reached, total }) => <Of {...{ reached, total }} /> },
    { key: "simulated", head: "Simulated changes", cell: ({ simulated }) => <Of {...simulated} /> },
    {
      key: "ecu",
      head: <>On the ECU, by ±8&nbsp;%</>,
      cell: ({ ecu }) => (paper.complete && ecu.total === 0 ? "not available" : <Of {...ecu} />),
    },
    {
      key: "within",
      head: "Within ±10 points",
      cell: ({ agreement }) => <Of reached={agreement.within} total={agreement.cells} />,
    },
    {
      key: "interval",
      head: "In our interval",
      cell: ({ agreement }) => <Of reached={agreement.in_interval} total={agreement.cells} />,
    },
    {
      key: "show",
      head: <span className="visually-hidden">Show it</span>,
      unprinted: true,
      cell: ({ id, title }) => (
        <Button
          size="compact-xs"
          disabled={id === paper.interpretation}
          aria-label={`Show ${title}`}
          onClick={() => onShow(id)}
        >
          {id === paper.interpretation ? "Shown" : "Show"}
        </Button>
      ),
    },
  ];
}
