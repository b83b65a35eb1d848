/** Which keys there are on this page. */

import { Kbd, Modal } from "@mantine/core";
import { ACTION_IDS, ACTIONS, isOffered } from "../lab/actions";
import { DataTable } from "../ui/DataTable";
import { keyNames } from "./keys";

const EVERYWHERE = [
  { label: "Slider or plot cursor: one step back or forward", keys: "← →" },
  { label: "Apply a typed value", keys: "Enter" },
  { label: "Discard a typed value, close a window", keys: "Esc" },
];

export function KeyList({ onClose }: { readonly onClose: () => void }) {
  const named = ACTION_IDS.filter(isOffered).flatMap((id) => {
    const { label, keys = [] } = ACTIONS[id];
    return keys.length > 0 ? [{ label, keys: keys.map(keyNames).join(" or ") }] : [];
  });
  return (
    <Modal opened onClose={onClose} title="Keys">
      <DataTable
        label="Keys"
        rows={[...named, ...EVERYWHERE]}
        rowKey={({ keys, label }) => keys + label}
        columns={[
          { key: "keys", head: "Key", text: true, cell: ({ keys }) => <Kbd>{keys}</Kbd> },
          { key: "label", head: "What it does", text: true, cell: ({ label }) => label },
        ]}
      />
    </Modal>
  );
}
