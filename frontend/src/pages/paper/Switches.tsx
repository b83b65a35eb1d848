/** Where the paper leaves something open, the reader chooses and the rest of the page follows; and what each switch does by itself. */

import { Box, Button, Group, SegmentedControl, Stack, Text } from "@mantine/core";
import { Fragment, useId } from "react";
import { Icon } from "../../ui/icons";
import type { Paper, PaperInterpretation, PaperReading, ReadingEffects } from "../../api/types";
import { count } from "../../units/format";
import { setOf, standardOf, useChoices, withChoice, withoutChoices, type Choices, withSet } from "./choices";
import { typeset } from "./numbers";
import { Of, VerdictCountList, countedOf, soFar, VerdictBar, countsInWords } from "./Verdict";
import ui from "../../ui/ui.module.css";
import { Columns } from "../../ui/Card";
import { useQuery } from "@tanstack/react-query";
import { effectsQuery, Answered, useVisible } from "./Waiting";
import { DataTable, type Column } from "../../ui/DataTable";
import { Note } from "../../ui/Messages";

interface Props {
  readonly paper: Paper;
  /** The answer to the choices is not there yet. */
  readonly waiting: boolean;
}

export function Switches({ paper, waiting }: Props) {
  const [choices, choose] = useChoices();
  // The address is ahead of the answer: a switch stands where it was put.
  const set = setOf(choices, paper.interpretations);
  const readings = paper.readings.map((reading) => ({ ...reading, chosen: choiceOf(reading, choices, set) }));
  const changed = readings.filter((reading) => reading.chosen !== standardOf(reading, set));
  return (
    <>
      <Group gap="0.4rem 1.1rem" mih="2rem" mb="0.6rem" role="status">
        <Text fw={600}>
          {waiting
            ? "Counting under these interpretations…"
            : `Of ${count(countedOf(paper, paper.counts), "cell")}${soFar(paper)}:`}
        </Text>
        <span style={{ opacity: waiting ? 0.5 : 1 }}>
          <VerdictCountList counts={paper.counts} />
        </span>
        <Button
          size="compact-xs"
          data-unprinted
          leftSection={<Icon name="Restore" size={14} />}
          disabled={changed.length === 0}
          onClick={() => choose(withoutChoices(choices, readings))}
        >
          {changed.length === 0
            ? `All as in the ${set?.title.toLowerCase() ?? "named"} set`
            : `Reset ${count(changed.length, "switch", "switches")}`}
        </Button>
      </Group>
      <Columns least="20rem">
        {readings.map((reading) => (
          <Switch
            key={reading.id}
            {...{ reading, set }}
            onChange={(choice) => choose(withChoice(choices, reading.id, choice, standardOf(reading, set)))}
          />
        ))}
      </Columns>
    </>
  );
}

function choiceOf(
  { id, choices: offered, chosen }: PaperReading,
  choices: Choices,
  set: PaperInterpretation | undefined,
): string {
  const requested = choices[id] ?? set?.choices[id];
  return offered.find((choice) => choice.id === requested)?.id ?? chosen;
}

interface SwitchProps {
  readonly reading: PaperReading;
  readonly set: PaperInterpretation | undefined;
  readonly onChange: (choice: string) => void;
}

function Switch({ reading, set, onChange }: SwitchProps) {
  const id = useId();
  const standard = reading.choices.find((choice) => choice.id === standardOf(reading, set));
  const current = reading.choices.find((choice) => choice.id === reading.chosen);
  const isChanged = standard !== current;
  return (
    <Stack
      className={ui.card ?? ""}
      gap="0.35rem"
      p="0.65rem 0.8rem 0.75rem"
      style={isChanged ? { boxShadow: "inset 4px 0 var(--accent)" } : {}}
      data-changed={isChanged || undefined}
    >
      <Group gap="0 0.8rem" align="baseline" justify="space-between">
        <Box component="h3" id={id} m={0} fz="sm" fw={650}>
          {typeset(reading.title)}
        </Box>
        {isChanged && standard && (
          <Box component="span" fz="xs" c="var(--accent)">
            {set?.title}: {typeset(standard.label)}
          </Box>
        )}
      </Group>
      <Box component="p" flex={1} m={0} fz="xs" lh="1.4" c="dimmed">
        <Inline text={reading.description} />
      </Box>
      <SegmentedControl
        aria-labelledby={id}
        style={{ alignSelf: "flex-start" }}
        value={reading.chosen}
        data={reading.choices.map((choice) => ({ value: choice.id, label: typeset(choice.label) }))}
        onChange={onChange}
      />
      {current && (
        <Box component="p" m={0} fz="xs" lh="1.4">
          {sourceOf(current.source)}
        </Box>
      )}
    </Stack>
  );
}

const sourceOf = (source: string) => (source === "ours" ? "Ours." : `${typeset(source)}.`);

type Effect = ReadingEffects["rows"][number];

interface Row extends Effect {
  readonly title: string;
  readonly label: string;
}

export function SwitchEffects({ paper: { readings, complete } }: Pick<Props, "paper">) {
  const [choices, choose] = useChoices();
  const { ref, visible } = useVisible();
  const expected = readings.reduce((sum, { choices: offered }) => sum + offered.length - 1, 0);
  return (
    <Box ref={ref}>
      <Answered
        query={useQuery({ ...effectsQuery(choices), enabled: visible && complete })}
        waiting={complete ? "Turning each switch by itself" : "Waiting for the runs of the tables"}
        height={24 + 40 * expected}
      >
        {(data) => (
          <>
            <DataTable
              label="What each switch does"
              card
              attributes={{ "data-testid": "effects" }}
              rows={data.rows.flatMap((row) => namesOf(row, readings))}
              rowKey={({ reading, choice }) => `${reading} ${choice}`}
              columns={columnsOf((row) =>
                choose({ ...withSet(choices, readings, "default"), [row.reading]: row.choice }),
              )}
            />
            {data.unavailable && <Note>Without the {data.unavailable.cells} cells that are not available here.</Note>}
            {!data.complete && <Note role="status">{count(expected - data.rows.length, "row")} to come …</Note>}
          </>
        )}
      </Answered>
    </Box>
  );
}

/** The row with its switch's names; none where the switch is of another version. */
function namesOf(row: Effect, readings: readonly PaperReading[]): readonly Row[] {
  const reading = readings.find(({ id }) => id === row.reading);
  if (!reading) return [];
  const label = reading.choices.find(({ id }) => id === row.choice)?.label ?? row.choice;
  return [{ ...row, title: typeset(reading.title), label: typeset(label) }];
}

function columnsOf(onTry: (row: Row) => void): readonly Column<Row>[] {
  return [
    {
      key: "switch",
      head: "Switch, alone",
      text: true,
      cell: ({ title, label }) => (
        <>
          {title}: <b>{label}</b>
        </>
      ),
    },
    {
      key: "reached",
      head: "Cells reached",
      cell: ({ reached, total }) => <Of {...{ reached, total }} />,
    },
    {
      key: "counts",
      head: "Reached, smaller, contradicts",
      text: true,
      attributes: ({ counts }) => ({ title: countsInWords(counts), style: { minWidth: "8rem" } }),
      cell: ({ counts }) => <VerdictBar counts={counts} />,
    },
    { key: "changed", head: "Other verdict", cell: ({ changed }) => (changed === 0 ? "none" : count(changed, "cell")) },
    {
      key: "try",
      head: <span className="visually-hidden">Try it</span>,
      unprinted: true,
      cell: (row) => (
        <Button size="compact-xs" aria-label={`Try ${row.title}: ${row.label}`} onClick={() => onTry(row)}>
          Try
        </Button>
      ),
    },
  ];
}

const PART = /(`[^`]+`|\*\*[^*]+\*\*|\*[^*]+\*)/;

/** A line of the server's Markdown: `code`, **bold** and *emphasis*; anything else stands as it is. */
export function Inline({ text }: { readonly text: string }) {
  return (
    <>
      {text.split(PART).map((part, index) => (
        <Fragment key={index}>{styled(part)}</Fragment>
      ))}
    </>
  );
}

function styled(part: string) {
  if (part.length > 2 && part.startsWith("`") && part.endsWith("`")) return <code>{part.slice(1, -1)}</code>;
  if (part.length > 4 && part.startsWith("**") && part.endsWith("**")) return <b>{part.slice(2, -2)}</b>;
  if (part.length > 2 && part.startsWith("*") && part.endsWith("*")) return <em>{part.slice(1, -1)}</em>;
  return typeset(part);
}
