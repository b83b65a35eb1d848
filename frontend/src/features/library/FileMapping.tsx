/** Asks what the columns of a measured road or of a recorded drive are, or where wheels run on a grid, before a file is sent. */

import { useSelector } from "@tanstack/react-store";
import { ask } from "../../api/http";
import { useLabContext } from "../../lab/context";
import { nameRecording } from "../../lab/recordings";
import { useCatalogue } from "../../server/useCatalogues";
import { formatNumber, prettyUnit } from "../../units/format";
import { unitsLike, parseQuantity } from "../../units/quantity";
import {
  columnsOf,
  type Use,
  driveKind,
  METRES,
  ROAD,
  guessLayout,
  guessUses,
  rewritten,
  tableOf,
  unitFault,
  unitOf,
  type Layout,
  type Table,
  type TableKind,
} from "./columns";
import { type Wheels } from "./files";
import { unclear, useOpenFiles, useSay } from "./open";
import { ProfileSketch } from "./ProfileSketch";
import { Template } from "./Template";
import { Button, Group, Modal, Checkbox, Text } from "@mantine/core";
import { useState, useMemo, type ReactNode } from "react";
import { Entry, Choice, choicesOf } from "../../ui/Entry";
import { Fault } from "../../ui/Messages";
import { submits } from "../../ui/ListEntry";
import { messageOf } from "../../api/problem";
import { DataTable } from "../../ui/DataTable";

export function FileMapping() {
  const [file] = useSelector(unclear);
  const catalogue = useCatalogue();
  const openFiles = useOpenFiles();
  const showDrive = useShowDrive();
  if (!file) return null;
  const next = () => unclear.set(unclear.get().slice(1));
  const driveRoad = async (road: File, wheels?: Wheels) => {
    const wrong = await openFiles([road], { wheels });
    if (wrong === null) next();
    return wrong;
  };
  if ("file" in file)
    return (
      <GridDialog key={file.name} name={file.name} onDrive={(wheels) => driveRoad(file.file, wheels)} onClose={next} />
    );
  const road: MappedKind = {
    ...ROAD,
    action: "Drive this road",
    aside: <Template />,
    Picture: RoadPicture,
    onMapped: (csv) => driveRoad(new File([csv], file.name)),
  };
  const drive: MappedKind = {
    ...driveKind(catalogue),
    action: "Show the drive",
    aside:
      "Position and clock need not fit: the drive is placed on this road where it is most like a simulated one. Empty cells are missing values.",
    Picture: DrivePicture,
    onMapped: async (csv) => {
      await showDrive(file.name, csv);
      next();
      return null;
    },
  };
  return <MappingDialog key={file.name} {...file} kinds={[road, drive]} onClose={next} />;
}

/** Sends a recorded drive and adds it to the strategies shown. */
function useShowDrive() {
  const { lab } = useLabContext();
  const say = useSay();
  return async (name: string, csv: string) => {
    const sent = await ask("post", "/recordings", { body: csv, query: {} });
    nameRecording(sent.strategy, name);
    const { strategies } = lab.get();
    lab.setStrategies([...strategies.filter((id) => id !== sent.strategy), sent.strategy]);
    say([`“${name}” is shown.`, ...sent.warnings]);
  };
}

function RoadPicture({ table, uses, layout }: PictureProps) {
  const columns = columnsOf(table, uses, layout.decimalComma);
  const metres = ({ role, unit }: Use) => (columns.get(role) ?? []).map((value) => value * (METRES[unit] ?? 1));
  const distance = uses.find(({ role }) => role === "distance");
  const heights = uses.filter(({ role }) => role !== "" && role !== "distance");
  return (
    <ProfileSketch
      label="The road as it is read"
      distance={distance ? metres(distance) : []}
      tracks={heights.map(metres)}
    />
  );
}

/** The first signal that has metrics, over time or else over distance. */
function DrivePicture({ table, uses, layout }: PictureProps) {
  const { signals, metric_signals } = useCatalogue();
  const columns = columnsOf(table, uses, layout.decimalComma);
  const of = (use: Use | undefined) => {
    const signal = signals.find(({ key }) => key === use?.role);
    const scale = unitsLike(signal?.unit ?? "1")[use?.unit ?? ""] ?? 1;
    return { values: (columns.get(use?.role ?? "") ?? []).map((value) => value * scale), ...signal };
  };
  const along = of(uses.find(({ role }) => role === "time") ?? uses.find(({ role }) => role === "position"));
  const drawn = of(uses.find(({ role }) => metric_signals.includes(role)));
  const caption = (low: number, high: number) =>
    `${drawn.label ?? ""}: ${formatNumber(low)} to ${formatNumber(high)} ${prettyUnit(drawn.unit ?? "1")}`;
  return (
    <ProfileSketch
      label="The drive as it is read"
      distance={along.values}
      tracks={[drawn.values]}
      caption={caption}
      unit={along.unit ?? ""}
    />
  );
}

interface Props {
  readonly name: string;
  /** The promise is what was wrong. */
  readonly onDrive: (wheels: Wheels) => Promise<string | null>;
  readonly onClose: () => void;
}

const SIDES = [
  { side: "left", label: "Left wheel", where: "v, to the left positive", usual: "0.75" },
  { side: "right", label: "Right wheel", where: "v, to the right negative", usual: "−0.75" },
] as const;

const placeOf = (text: string) =>
  text.trim() === "" ? ({ ok: true, value: null } as const) : parseQuantity(text, "m");

function GridDialog({ name, onDrive, onClose }: Props) {
  const [typed, setTyped] = useState({ left: "", right: "" });
  const [wrong, setWrong] = useState<string | null>(null);
  const [isBusy, setBusy] = useState(false);
  const places = { left: placeOf(typed.left), right: placeOf(typed.right) };
  const go = async ({ left, right }: typeof places) => {
    if (!left.ok || !right.ok) return;
    setBusy(true);
    setWrong(await onDrive({ left: left.value, right: right.value }));
    setBusy(false);
  };
  return (
    <Modal opened onClose={onClose} title={`Wheels on ${name}`}>
      <form onSubmit={submits(() => void go(places))}>
        <Group grow align="start">
          {SIDES.map(({ side, label, where, usual }) => (
            <Entry
              key={side}
              label={label}
              description={where}
              placeholder={usual}
              unit="m"
              value={typed[side]}
              error={places[side].ok ? null : places[side].message}
              onType={(text) => {
                setTyped({ ...typed, [side]: text });
                setWrong(null);
              }}
            />
          ))}
        </Group>
        {wrong !== null && <Fault>{wrong}</Fault>}
        <Group justify="end" gap="xs" mt="sm">
          <Button variant="default" onClick={onClose}>
            Cancel
          </Button>
          <Button variant="filled" type="submit" data-autofocus loading={isBusy}>
            Drive this road
          </Button>
        </Group>
      </form>
    </Modal>
  );
}

/** Asks what a table is of and what its columns are, and shows what comes of the answer. */
interface PictureProps {
  readonly table: Table;
  readonly uses: readonly Use[];
  readonly layout: Layout;
}

/** What a table may be of, and what becomes of it. */
interface MappedKind extends TableKind {
  /** Of the button that goes on. */
  readonly action: string;
  /** Beside the buttons. */
  readonly aside: ReactNode;
  /** Of the mapped table. */
  readonly Picture: (props: PictureProps) => ReactNode;
  /** With the mapped table as CSV; fails, or says what is wrong with it. */
  readonly onMapped: (csv: string) => Promise<string | null>;
}

interface MappingProps {
  readonly name: string;
  readonly text: string;
  readonly kinds: readonly MappedKind[];
  /** The kind that it looks like. */
  readonly likely: string;
  readonly onClose: () => void;
}

const SEPARATORS = choicesOf({ ",": "Commas", ";": "Semicolons", "\t": "Tabs", " ": "Blanks" });
/** Rows in the table. */
const SHOWN = 6;

function MappingDialog({ name, text, kinds, likely, onClose }: MappingProps) {
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
          data={SEPARATORS}
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
