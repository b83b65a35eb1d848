/** Asks what the columns of a measured road or of a recorded drive are, or where wheels run on a grid, before a file is sent. */

import { useSelector } from "@tanstack/react-store";
import { ask } from "../../api/http";
import { useLabContext } from "../../lab/context";
import { nameRecording } from "../../lab/recordings";
import { useCatalogue } from "../../server/useCatalogues";
import { formatNumber, prettyUnit } from "../../units/format";
import { unitsLike, parseQuantity } from "../../units/quantity";
import { columnsOf, type Use } from "./columns";
import type { Wheels } from "./files";
import { MappingDialog, type MappedKind, type PictureProps } from "./MappingDialog";
import { unclear, useOpenFiles, useSay } from "./open";
import { ProfileSketch } from "./ProfileSketch";
import { driveKind, METRES, ROAD } from "./columns";
import { Template } from "./Template";
import { Button, Group, Modal } from "@mantine/core";
import { useState } from "react";
import { Entry } from "../../ui/Entry";
import { Fault } from "../../ui/Messages";
import { submits } from "../../ui/ListEntry";

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
