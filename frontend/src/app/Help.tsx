/** Where one learns more: the tour, the manual, and which keys there are on this page. */

import { Button, Group, Kbd, Modal } from "@mantine/core";
import { ACTION_IDS, ACTIONS, isOffered, useActionButton } from "../lab/actions";
import { DataTable } from "../ui/DataTable";
import { Icon } from "../ui/icons";
import { MANUAL } from "../ui/manual";
import { keyNames } from "./keys";

const EVERYWHERE = [
  { label: "Slider or plot cursor: one step back or forward", keys: "← →" },
  { label: "Apply a typed value", keys: "Enter" },
  { label: "Discard a typed value, close a window", keys: "Esc" },
];

export function Help({ onClose }: { readonly onClose: () => void }) {
  const tour = useActionButton("tour");
  const named = ACTION_IDS.filter(isOffered).flatMap((id) => {
    const { label, keys = [] } = ACTIONS[id];
    return keys.length > 0 ? [{ label, keys: keys.map(keyNames).join(" or ") }] : [];
  });
  return (
    <Modal opened onClose={onClose} title="Help">
      <Group gap="0.5rem" mb="0.7rem">
        {isOffered("tour") && (
          <Button
            variant="light"
            onClick={() => {
              onClose();
              tour.onClick();
            }}
          >
            {tour.label}
          </Button>
        )}
        <Button component="a" href={MANUAL} target="_blank" rightSection={<Icon name="ExternalLink" size={14} />}>
          Read the manual
        </Button>
      </Group>
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
