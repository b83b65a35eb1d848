/** Says that a part of the page is not there. */

import { Button, Group, Modal, Text } from "@mantine/core";

interface Props {
  readonly onClose?: (() => void) | undefined;
}

export function PartFailed({ onClose }: Props) {
  return (
    <Modal
      opened
      onClose={onClose ?? (() => undefined)}
      withCloseButton={onClose !== undefined}
      title="This part of the page could not be shown"
    >
      <Text>
        Ridelab may have been updated since this page was loaded. Loading it again shows what was computed: it is stored
        at this address.
      </Text>
      <Group justify="flex-end" gap="xs" mt="md">
        {onClose && (
          <Button size="sm" onClick={onClose}>
            Close
          </Button>
        )}
        <Button size="sm" variant="filled" onClick={() => window.location.reload()}>
          Load again
        </Button>
      </Group>
    </Modal>
  );
}
