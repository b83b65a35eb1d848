/** Asks what a table is of and what its columns are, and shows what comes of the answer. */

import { Button, Checkbox, Group, Modal, Text } from "@mantine/core";
import { useMemo, useState, type ReactNode } from "react";
import { messageOf } from "../../api/problem";
import { DataTable } from "../../ui/DataTable";
import { Fault } from "../../ui/Messages";
import { prettyUnit } from "../../units/format";
import {
  guessLayout,
  guessUses,
  rewritten,
  tableOf,
  unitFault,
  unitOf,
  type Layout,
  type Table,
  type TableKind,
  type Use,
} from "./columns";
import { Choice } from "../../ui/Entry";

export interface PictureProps {
  readonly table: Table;
  readonly uses: readonly Use[];
  readonly layout: Layout;
}

/** What a table may be of, and what becomes of it. */
export interface MappedKind extends TableKind {
  /** Of the button that goes on. */
  readonly action: string;
  /** Beside the buttons. */
  readonly aside: ReactNode;
  /** Of the mapped table. */
  readonly Picture: (props: PictureProps) => ReactNode;
  /** With the mapped table as CSV; fails, or says what is wrong with it. */
  readonly onMapped: (csv: string) => Promise<string | null>;
}

interface Props {
  readonly name: string;
  readonly text: string;
  readonly kinds: readonly MappedKind[];
  /** The kind that it looks like. */
  readonly likely: string;
  readonly onClose: () => void;
}

const SEPARATORS = [
  { value: ",", label: "Commas" },
  { value: ";", label: "Semicolons" },
  { value: "\t", label: "Tabs" },
  { value: " ", label: "Blanks" },
] as const;
/** Rows in the table. */
const SHOWN = 6;

export function MappingDialog({ name, text, kinds, likely, onClose }: Props) {
  const [layout, setLayout] = useState(() => guessLayout(text));
  const [kindId, setKind] = useState(likely);
  const [edited, setEdited] = useState<readonly Use[] | null>(null);
  const [wrong, setWrong] = useState<string | null>(null);
  const [isBusy, setBusy] = useState(false);
  const table = useMemo(() => tableOf(text, layout), [text, layout]);
  const kind = kinds.find(({ id }) => id === kindId);
  if (!kind) return null;
  const roleOf = (role: string) => kind.roles.find(({ id }) => id === role);
  const uses = edited ?? guessUses(table, kind);
  const choose = (next: readonly Use[] | null) => {
    setEdited(next);
    setWrong(null);
  };
  const relay = (change: Partial<Layout>) => {
    setLayout({ ...layout, ...change });
    choose(null);
  };
  const use = (index: number, change: Partial<Use>) =>
    choose(uses.map((each, at) => (at === index ? { ...each, ...change } : each)));
  const fault =
    table.rows.length === 0 ? "There are no rows" : (kind.faultOf(uses) ?? unitFault(table.titles, uses, kind.roles));
  const go = async () => {
    setBusy(true);
    setWrong(await kind.onMapped(rewritten(text, layout, uses)).catch(messageOf));
    setBusy(false);
  };
  const columns = table.titles.map((title, index) => ({
    key: String(index),
    head: (
      <>
        {title}
        <Choice
          aria-label={`${title} is`}
          miw={110}
          value={uses[index]?.role ?? ""}
          data={[{ value: "", label: "left out" }, ...kind.roles.map(({ id, label }) => ({ value: id, label }))]}
          onPick={(value) => {
            const role = roleOf(value);
            use(index, { role: value, unit: role ? unitOf(title, role) : "" });
          }}
        />
        <Choice
          aria-label={`Unit of ${title}`}
          value={uses[index]?.unit ?? ""}
          disabled={uses[index]?.role === ""}
          error={uses[index]?.role !== "" && uses[index]?.unit === ""}
          data={[
            ...(uses[index]?.unit === "" ? [{ value: "", label: uses[index].role === "" ? "" : "choose" }] : []),
            ...(roleOf(uses[index]?.role ?? "")?.units ?? []).map((unit) => ({ value: unit, label: prettyUnit(unit) })),
          ]}
          onPick={(value) => use(index, { unit: value })}
        />
      </>
    ),
    cell: (row: { readonly cells: readonly string[] }) => (row.cells[index] === "" ? "–" : row.cells[index]),
  }));
  return (
    <Modal opened onClose={onClose} title={`Columns of ${name}`} size="xl">
      <Group gap="sm" align="end" mb="sm">
        <Choice
          label="The file is of"
          value={kind.id}
          data={kinds.map(({ id, label }) => ({ value: id, label }))}
          onPick={(value) => {
            setKind(value);
            choose(null);
          }}
        />
        <Choice
          label="Between columns"
          value={layout.separator}
          data={[...SEPARATORS]}
          onPick={(value) => relay({ separator: value as Layout["separator"] })}
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
      {fault === null && <kind.Picture {...{ table, uses, layout }} />}
      {(wrong ?? fault) !== null && <Fault>{wrong ?? fault}</Fault>}
      <Group justify="space-between" mt="sm">
        <Text component="div" fz="xs" c="dimmed" flex="1 1 14rem">
          {kind.aside}
        </Text>
        <Group gap="xs">
          <Button variant="default" onClick={onClose}>
            Cancel
          </Button>
          <Button variant="filled" data-autofocus disabled={fault !== null} loading={isBusy} onClick={() => void go()}>
            {kind.action}
          </Button>
        </Group>
      </Group>
    </Modal>
  );
}
