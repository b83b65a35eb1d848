/** Which keys there are on this page. */

import { Kbd, Modal, Table } from "@mantine/core";
import { commands } from "../state/commands";
import { keyNames } from "./keyNames";

const EVERYWHERE = [
  { label: "Slider or plot cursor: one step back or forward", keys: "← →" },
  { label: "Apply a typed value", keys: "Enter" },
  { label: "Discard a typed value, close a window", keys: "Esc" },
];

export function KeyList({ onClose }: { readonly onClose: () => void }) {
  const named = commands().flatMap(({ label, keys }) => (keys === undefined ? [] : [{ label, keys: keyNames(keys) }]));
  return (
    <Modal opened onClose={onClose} title="Keys" closeButtonProps={{ "aria-label": "Close" }}>
      <Table>
        <Table.Tbody>
          {[...named, ...EVERYWHERE].map(({ label, keys }) => (
            <Table.Tr key={keys + label}>
              <Table.Td>
                <Kbd>{keys}</Kbd>
              </Table.Td>
              <Table.Td>{label}</Table.Td>
            </Table.Tr>
          ))}
        </Table.Tbody>
      </Table>
    </Modal>
  );
}
