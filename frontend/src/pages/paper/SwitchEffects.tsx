/** What each switch does by itself: the count with it alone turned from Ridelab's reading. */

import { Button } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import type { Paper, PaperReading, ReadingEffects } from "../../api/types";
import { count } from "../../units/format";
import { withSet, type Choices } from "./choices";
import { typeset } from "./numbers";
import { effectsQuery } from "./queries";
import { useVisible, Fault, Waiting } from "./Waiting";
import { VerdictBar, countsInWords } from "./Verdict";
import { DataTable, type Column } from "../../ui/DataTable";
import { Note } from "../../ui/Messages";

interface Props {
  readonly paper: Paper;
  readonly choices: Choices;
  readonly onChoose: (choices: Choices) => void;
}

type Effect = ReadingEffects["rows"][number];

interface Row extends Effect {
  readonly title: string;
  readonly label: string;
}

export function SwitchEffects({ paper: { readings, complete }, choices, onChoose }: Props) {
  const { ref, visible } = useVisible();
  const { data, error, refetch } = useQuery({ ...effectsQuery(choices), enabled: visible && complete });
  const expected = readings.reduce((sum, { choices: offered }) => sum + offered.length - 1, 0);
  if (error && !data) return <Fault message={error.message} onRetry={() => void refetch()} />;
  if (!data) {
    return (
      <div ref={ref} data-unprinted>
        <Waiting
          key={String(visible && complete)}
          what={complete ? "Turning each switch by itself" : "Waiting for the runs of the tables"}
          height={24 + 40 * expected}
        />
      </div>
    );
  }
  return (
    <>
      <DataTable
        label="What each switch does"
        card
        attributes={{ "data-testid": "effects" }}
        rows={data.rows.flatMap((row) => namesOf(row, readings))}
        rowKey={({ reading, choice }) => `${reading} ${choice}`}
        columns={columnsOf((row) => onChoose({ ...withSet(choices, readings, "default"), [row.reading]: row.choice }))}
      />
      {data.unavailable && <Note>Without the {data.unavailable.cells} cells that are not available here.</Note>}
      {!data.complete && <Note role="status">{count(expected - data.rows.length, "row")} to come …</Note>}
    </>
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
      cell: ({ reached, total }) => (
        <>
          <b>{reached}</b> of {total}
        </>
      ),
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
