/** Asks where the wheels run on a grid of heights before its file is sent. */

import { Button, Group, Modal } from "@mantine/core";
import { useState } from "react";
import { Entry } from "../../ui/Entry";
import { Fault } from "../../ui/Fault";
import { parseQuantity } from "../../units/quantity";
import type { Wheels } from "./files";

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

export function GridDialog({ name, onDrive, onClose }: Props) {
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
      <form
        onSubmit={(event) => {
          event.preventDefault();
          void go(places);
        }}
      >
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
