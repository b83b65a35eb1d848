/** Asks what the columns of a measured road or of a recorded drive are, or where wheels run on a grid, before a file is sent. */

import { useSelector } from "@tanstack/react-store";
import { useLabContext } from "../../lab/context";
import { nameRecording } from "../../lab/recordings";
import { parseQuantity } from "../../units/quantity";
import { type Wheels } from "./files";
import { unclear, useOpenFiles, useSay } from "./open";
import { TableDialog } from "./TableDialog";
import { uploadDrive } from "./upload";
import { Button, Group, Modal } from "@mantine/core";
import { useState } from "react";
import { Entry } from "../../ui/Entry";
import { Fault } from "../../ui/Messages";
import { submits } from "../../ui/ListEntry";

export function FileMapping() {
  const [file] = useSelector(unclear);
  const openFiles = useOpenFiles();
  const showDrive = useShowDrive();
  if (!file) return null;
  const next = () => unclear.set(unclear.get().slice(1));
  const driveRoad = async (road: File, options: { readonly wheels: Wheels } | { readonly table: string }) => {
    const wrong = await openFiles([road], options);
    if (wrong === null) next();
    return wrong;
  };
  if ("grid" in file)
    return (
      <GridDialog
        key={file.name}
        name={file.name}
        onDrive={(wheels) => driveRoad(file.grid, { wheels })}
        onClose={next}
      />
    );
  const take = async (kind: string, table: string) => {
    if (kind === "road") return driveRoad(file.file, { table });
    await showDrive(file.file, table);
    next();
    return null;
  };
  return <TableDialog key={file.name} {...file} onTake={take} onClose={next} />;
}

/** Sends a recorded drive and adds it to the strategies shown. */
function useShowDrive() {
  const { lab } = useLabContext();
  const say = useSay();
  return async (file: File, table: string) => {
    const sent = await uploadDrive(file, table);
    nameRecording(sent.strategy, file.name);
    const { strategies } = lab.get();
    lab.setStrategies([...strategies.filter((id) => id !== sent.strategy), sent.strategy]);
    say([`“${file.name}” is shown.`, ...sent.warnings]);
  };
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
