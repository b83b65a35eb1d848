/** Asks what the columns of a table are, and shows what comes of the answer. */

import { Button, Checkbox, Group, Modal, NativeSelect, Text } from "@mantine/core";
import { useMemo, useState, type ReactNode } from "react";
import { DataTable } from "../../ui/DataTable";
import { Fault } from "../../ui/Fault";
import { guessLayout, guessUses, rewritten, tableOf, type Layout, type Role, type Table, type Use } from "./columns";

interface Props {
  readonly title: string;
  readonly text: string;
  readonly roles: readonly Role[];
  /** The roles of columns without titles. */
  readonly places: (columns: number) => readonly string[];
  /** What is missing or twice among the roles; `null` where nothing is. */
  readonly faultOf: (uses: readonly Use[]) => string | null;
  /** A picture of the mapped table. */
  readonly picture: (table: Table, uses: readonly Use[], layout: Layout) => ReactNode;
  /** Of the button that goes on. */
  readonly action: string;
  /** With the mapped table as CSV; the promise is what is wrong with it. */
  readonly onMapped: (csv: string) => Promise<string | null>;
  readonly onClose: () => void;
  /** Beside the buttons. */
  readonly aside?: ReactNode;
}

const SEPARATORS = [
  { value: ",", label: "Commas" },
  { value: ";", label: "Semicolons" },
  { value: "\t", label: "Tabs" },
  { value: " ", label: "Blanks" },
] as const;
/** Rows in the table. */
const SHOWN = 6;

export function MappingDialog({
  title,
  text,
  roles,
  places,
  faultOf,
  picture,
  action,
  onMapped,
  onClose,
  aside,
}: Props) {
  const [layout, setLayout] = useState(() => guessLayout(text));
  const [chosen, setChosen] = useState<readonly Use[] | null>(null);
  const [wrong, setWrong] = useState<string | null>(null);
  const [isBusy, setBusy] = useState(false);
  const table = useMemo(() => tableOf(text, layout), [text, layout]);
  const unitOf = (role: string) => roles.find(({ id }) => id === role)?.units[0] ?? "";
  const uses = (chosen ?? guessUses(table, roles, places)).map(({ role, unit }) => ({
    role,
    unit: unit || unitOf(role),
  }));
  const relay = (change: Partial<Layout>) => {
    setLayout({ ...layout, ...change });
    setChosen(null);
    setWrong(null);
  };
  const use = (index: number, change: Partial<Use>) => {
    setChosen(uses.map((each, at) => (at === index ? { ...each, ...change } : each)));
    setWrong(null);
  };
  const fault = table.rows.length === 0 ? "There are no rows" : faultOf(uses);
  const go = async () => {
    setBusy(true);
    setWrong(await onMapped(rewritten(text, layout, uses)));
    setBusy(false);
  };
  const columns = table.titles.map((name, index) => ({
    key: String(index),
    head: (
      <>
        {name}
        <NativeSelect
          aria-label={`${name} is`}
          value={uses[index]?.role ?? ""}
          data={[{ value: "", label: "left out" }, ...roles.map(({ id, label }) => ({ value: id, label }))]}
          onChange={(event) => use(index, { role: event.currentTarget.value, unit: unitOf(event.currentTarget.value) })}
        />
        <NativeSelect
          aria-label={`Unit of ${name}`}
          value={uses[index]?.unit ?? ""}
          disabled={uses[index]?.role === ""}
          data={[...(roles.find(({ id }) => id === uses[index]?.role)?.units ?? [""])]}
          onChange={(event) => use(index, { unit: event.currentTarget.value })}
        />
      </>
    ),
    cell: (row: { readonly cells: readonly string[] }) => row.cells[index] ?? "",
  }));
  return (
    <Modal opened onClose={onClose} title={title} size="xl">
      <Group gap="sm" align="end" mb="sm">
        <NativeSelect
          label="Between columns"
          value={layout.separator}
          data={[...SEPARATORS]}
          onChange={(event) => relay({ separator: event.currentTarget.value as Layout["separator"] })}
        />
        <Checkbox
          label="Decimal commas"
          checked={layout.decimalComma}
          disabled={layout.separator === ","}
          onChange={(event) => relay({ decimalComma: event.currentTarget.checked })}
        />
        <Checkbox
          label="The first line has titles"
          checked={layout.hasHeader}
          onChange={(event) => relay({ hasHeader: event.currentTarget.checked })}
        />
      </Group>
      <DataTable
        label="The first rows of the file"
        columns={columns}
        rows={table.rows.slice(0, SHOWN).map((cells, index) => ({ cells, index }))}
        rowKey={({ index }) => index}
      />
      {fault === null && picture(table, uses, layout)}
      {(wrong ?? fault) !== null && <Fault>{wrong ?? fault}</Fault>}
      <Group justify="space-between" mt="sm">
        <Text component="div" fz="xs" c="dimmed">
          {aside}
        </Text>
        <Group gap="xs">
          <Button variant="default" onClick={onClose}>
            Cancel
          </Button>
          <Button variant="filled" data-autofocus disabled={fault !== null} loading={isBusy} onClick={() => void go()}>
            {action}
          </Button>
        </Group>
      </Group>
    </Modal>
  );
}
