/** What each switch does by itself: the count with it alone turned from Ridelab's reading. */

import { Button, Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import type { Paper, PaperReading, ReadingEffects } from "../api/types";
import { count } from "../units/format";
import { withSet, type Choices } from "./choices";
import { typeset } from "./numbers";
import tables from "./tables.module.css";
import { effectsQuery } from "./queries";
import { useVisible } from "./useVisible";
import { VerdictBar } from "./Verdict";
import { countsInWords } from "./verdicts";
import { Fault, Waiting } from "./Waiting";
import { ScrollTable } from "../ui/ScrollTable";

interface Props {
  readonly paper: Paper;
  readonly choices: Choices;
  readonly onChoose: (choices: Choices) => void;
}

type Row = ReadingEffects["rows"][number];

export function SwitchEffects({ paper: { readings, complete }, choices, onChoose }: Props) {
  const { ref, visible } = useVisible();
  const { data, error, refetch } = useQuery({ ...effectsQuery(choices), enabled: visible && complete });
  const expected = readings.reduce((sum, { choices: offered }) => sum + offered.length - 1, 0);
  if (error && !data) return <Fault message={error.message} onRetry={() => void refetch()} />;
  if (!data) {
    return (
      <div ref={ref} className={tables.unprinted}>
        <Waiting key={String(visible && complete)} what={complete ? "Turning each switch by itself" : "Waiting for the runs of the tables"} height={24 + 40 * expected} />
      </div>
    );
  }
  return (
    <>
      <ScrollTable label="What each switch does" card className={`${tables.table ?? ""} ${tables.effects ?? ""}`} data-testid="effects">
        <thead>
          <tr>
            <th scope="col">Switch, alone</th>
            <th scope="col" className={tables.number}>
              Cells reached
            </th>
            <th scope="col" className={tables.barColumn}>
              Reached, smaller, contradicts
            </th>
            <th scope="col" className={tables.number}>
              Other verdict
            </th>
            <th scope="col" className={tables.unprinted}>
              <span className="visually-hidden">Try it</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {data.rows.map((row) => {
            const reading = readings.find(({ id }) => id === row.reading);
            if (!reading) return null;
            return <EffectRow key={`${row.reading} ${row.choice}`} row={row} reading={reading} onTry={() => onChoose({ ...withSet(choices, readings, "default"), [reading.id]: row.choice })} />;
          })}
        </tbody>
      </ScrollTable>
      {data.unavailable && (
        <Text size="xs" c="dimmed">
          Without the {data.unavailable.cells} cells that are not available here.
        </Text>
      )}
      {!data.complete && (
        <Text size="xs" c="dimmed" role="status">
          {count(expected - data.rows.length, "row")} to come …
        </Text>
      )}
    </>
  );
}

function EffectRow({ row, reading, onTry }: { readonly row: Row; readonly reading: PaperReading; readonly onTry: () => void }) {
  const label = reading.choices.find(({ id }) => id === row.choice)?.label ?? row.choice;
  const [title, choice] = [typeset(reading.title), typeset(label)];
  return (
    <tr>
      <th scope="row" className={tables.rowName}>
        {title}: <b>{choice}</b>
      </th>
      <td className={tables.number}>
        <b>{row.reached}</b> of {row.total}
      </td>
      <td className={tables.barColumn} title={countsInWords(row.counts)}>
        <VerdictBar counts={row.counts} />
      </td>
      <td className={tables.number}>{row.changed === 0 ? "none" : count(row.changed, "cell")}</td>
      <td className={tables.unprinted}>
        <Button size="compact-xs" variant="default" aria-label={`Try ${title}: ${choice}`} onClick={onTry}>
          Try
        </Button>
      </td>
    </tr>
  );
}
