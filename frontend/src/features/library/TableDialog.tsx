/** Shows how the server reads a table, and sends what is said of it in place of what was found. */

import { useCatalogue } from "../../server/useCatalogues";
import type { DescribedTable } from "../../api/types";
import { messageOf } from "../../api/problem";
import { formatNumber, prettyUnit } from "../../units/format";
import { unitsLike } from "../../units/quantity";
import { describe } from "./upload";
import { ProfileSketch } from "./ProfileSketch";
import { Template } from "./Template";
import { Box, Button, Checkbox, Group, Modal, Text } from "@mantine/core";
import { useState } from "react";
import { Choice, choicesOf, Entry } from "../../ui/Entry";
import { Fault } from "../../ui/Messages";
import { submits } from "../../ui/ListEntry";
import { DataTable } from "../../ui/DataTable";

type Table = DescribedTable["table"];
type Column = Table["columns"][number];

interface Props {
  readonly name: string;
  readonly file: File;
  readonly described: DescribedTable;
  /** With what is said of the table; the promise is what was wrong. */
  readonly onTake: (kind: Table["kind"], table: string) => Promise<string | null>;
  readonly onClose: () => void;
}

const SEPARATORS = choicesOf({ ",": "Commas", ";": "Semicolons", "\t": "Tabs", "|": "Bars", " ": "Blanks" });
const ROAD_MEANINGS = { distance: "Distance", height: "Height", left: "Left height", right: "Right height" };
const KINDS = choicesOf({ road: "a measured road", drive: "a recorded drive" });

/** What decides how a table is read, without what is told beside it; with its guesses, or without what is asked. */
function decided(table: Table, { withGuesses }: { readonly withGuesses: boolean }): Partial<Table> {
  const asked = withGuesses ? [] : table.questions.map(({ field }) => field);
  const isAsked = (place: string) => asked.some((field) => field.startsWith(place));
  const columns = table.columns.filter(
    ({ index, means, sure }) => (means !== null || sure) && !isAsked(`/columns/${index}/`),
  );
  const plain = ["separator", "decimal", "encoding", "sheet", "titles_line", "clock", "bridge", "from", "to"];
  const said = Object.entries(table).filter(
    ([name]) => name === "kind" || (plain.includes(name) && !isAsked(`/${name}`)),
  );
  return { ...Object.fromEntries(said), columns };
}

export function TableDialog({ name, file, described: first, onTake, onClose }: Props) {
  const [described, setDescribed] = useState(first);
  const [wrong, setWrong] = useState<string | null>(null);
  const [isBusy, setBusy] = useState(false);
  const { table, curve } = described;
  const busily = async (work: () => Promise<string | null>) => {
    setBusy(true);
    setWrong(await work().catch(messageOf));
    setBusy(false);
  };
  const say = (change: object) =>
    busily(async () => {
      setDescribed(await describe(file, JSON.stringify(change)));
      return null;
    });
  const correct = (change: Partial<Table>) => say({ ...decided(table, { withGuesses: false }), ...change });
  const correctColumn = (column: Column) => {
    const { columns = [] } = decided(table, { withGuesses: false });
    return correct({ columns: [...columns.filter(({ index }) => index !== column.index), column] });
  };
  const action = table.kind === "road" ? "Drive this road" : "Show the drive";
  return (
    <Modal opened onClose={onClose} title={`Columns of ${name}`} size="xl">
      <Box component="fieldset" bd="none" p={0} m={0} miw={0} disabled={isBusy}>
        <Group gap="sm" align="end" mb="sm">
          <Choice
            label="The file is of"
            value={table.kind}
            data={KINDS}
            onPick={(kind) => void say({ kind, separator: table.separator, decimal: table.decimal })}
          />
          <Choice
            label="Between columns"
            value={table.separator}
            data={SEPARATORS}
            onPick={(separator) => void say({ kind: table.kind, separator })}
          />
          <Checkbox
            label="Decimal commas"
            checked={table.decimal === ","}
            disabled={table.separator === ","}
            onChange={(event) => void correct({ decimal: event.currentTarget.checked ? "," : "." })}
          />
          {table.clock.column === null && (
            <Answer
              key={table.kind}
              label={table.kind === "road" ? "Between two heights" : "Rows in a second"}
              unit={table.kind === "road" ? "m" : "Hz"}
              value={table.kind === "road" ? table.clock.spacing : table.clock.rate}
              onAnswer={(value) =>
                void correct({ clock: { ...table.clock, [table.kind === "road" ? "spacing" : "rate"]: value } })
              }
            />
          )}
          {table.bridge !== null && (
            <Answer
              label="Longest gap to bridge"
              unit="m"
              value={table.bridge}
              onAnswer={(bridge) => void correct({ bridge })}
            />
          )}
          {(table.from !== null || table.to !== null) && (
            <>
              <Answer label="From" unit="" value={table.from} onAnswer={(from) => void correct({ from })} />
              <Answer label="To" unit="" value={table.to} onAnswer={(to) => void correct({ to })} />
            </>
          )}
        </Group>
        <Preview table={table} onCorrect={(column) => void correctColumn(column)} />
      </Box>
      <Drawn curve={curve} />
      {table.questions.map(({ field, text }) => (
        <Fault key={field}>{text}</Fault>
      ))}
      {wrong !== null && <Fault>{wrong}</Fault>}
      {table.notes.map((note) => (
        <Text key={note} fz="xs" c="dimmed">
          {note}
        </Text>
      ))}
      <Group justify="space-between" mt="sm">
        <Text component="div" fz="xs" c="dimmed" flex="1 1 14rem">
          {table.kind === "road" ? (
            <Template />
          ) : (
            "Position and clock need not fit: the drive is placed on this road where it is most like a simulated one. Empty cells are missing values."
          )}
        </Text>
        <Group gap="xs">
          <Button variant="default" onClick={onClose}>
            Cancel
          </Button>
          {table.questions.some(({ guess }) => guess !== null) && (
            <Button variant="default" loading={isBusy} onClick={() => void say(decided(table, { withGuesses: true }))}>
              The guesses are right
            </Button>
          )}
          <Button
            variant="filled"
            data-autofocus
            disabled={table.questions.length > 0}
            loading={isBusy}
            onClick={() => void busily(() => onTake(table.kind, JSON.stringify(decided(table, { withGuesses: true }))))}
          >
            {action}
          </Button>
        </Group>
      </Group>
    </Modal>
  );
}

interface PreviewProps {
  readonly table: Table;
  readonly onCorrect: (column: Column) => void;
}

function Preview({ table, onCorrect }: PreviewProps) {
  const { signals } = useCatalogue();
  const meanings: Readonly<Record<string, string>> =
    table.kind === "road" ? ROAD_MEANINGS : Object.fromEntries(signals.map(({ key, label }) => [key, label]));
  const unitsOf = (means: string | null) =>
    means === null
      ? []
      : Object.keys(unitsLike(table.kind === "road" ? "m" : (signals.find(({ key }) => key === means)?.unit ?? "1")));
  const columns = table.columns.map((column) => ({
    key: String(column.index),
    head: (
      <>
        {column.title}
        <Choice
          aria-label={`${column.title} is`}
          miw={110}
          value={column.means ?? ""}
          data={[
            { value: "", label: "left out" },
            ...Object.entries(meanings).map(([value, label]) => ({ value, label })),
          ]}
          onPick={(means) => onCorrect({ ...column, means: means === "" ? null : means, sure: true })}
        />
        <Choice
          aria-label={`Unit of ${column.title}`}
          value={column.unit}
          disabled={column.means === null}
          error={column.means !== null && !column.sure}
          data={[...new Set([column.unit, ...unitsOf(column.means)])].map((unit) => ({
            value: unit,
            label: prettyUnit(unit),
          }))}
          onPick={(unit) => onCorrect({ ...column, unit, sure: true })}
        />
      </>
    ),
    cell: ({ cells }: { readonly cells: readonly string[] }) => {
      const cell = cells[column.index];
      return cell === "" ? "–" : cell;
    },
  }));
  return (
    <DataTable
      label="The first rows of the file"
      columns={columns}
      rows={table.preview.map((cells, index) => ({ cells, index }))}
      rowKey={({ index }) => index}
    />
  );
}

function Drawn({ curve }: Pick<DescribedTable, "curve">) {
  const { signals } = useCatalogue();
  if (!curve) return null;
  const drawn = signals.find(({ key }) => key === curve.signals[0]);
  const caption = (low: number, high: number) =>
    `${drawn?.label ?? ""}: ${formatNumber(low)} to ${formatNumber(high)} ${prettyUnit(drawn?.unit ?? "1")}`;
  const tracks = curve.values.map((values) => values.map((value) => value ?? NaN));
  return (
    <ProfileSketch
      label={drawn ? "The drive as it is read" : "The road as it is read"}
      distance={curve.x}
      tracks={tracks}
      {...(drawn && { caption, unit: curve.along === "time" ? "s" : "m" })}
    />
  );
}

interface AnswerProps {
  readonly label: string;
  readonly unit: string;
  readonly value: number | null;
  readonly onAnswer: (value: number) => void;
}

/** A number that is sent when it is left, or with Enter. */
function Answer({ label, unit, value, onAnswer }: AnswerProps) {
  const [typed, setTyped] = useState(value === null ? "" : String(value));
  const number = Number(typed.replace(",", "."));
  const isNumber = typed.trim() !== "" && Number.isFinite(number);
  const send = () => {
    if (isNumber && number !== value) onAnswer(number);
  };
  return (
    <form onSubmit={submits(send)}>
      <Entry label={label} unit={unit} value={typed} onType={setTyped} onBlur={send} />
    </form>
  );
}
