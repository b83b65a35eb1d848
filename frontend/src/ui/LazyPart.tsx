/** A part of the page whose code is fetched when it is wanted. */

import { Button, Group, Modal, Text } from "@mantine/core";
import { CatchBoundary } from "@tanstack/react-router";
import { Suspense, type ReactNode } from "react";

interface Props {
  /** What stands in its place until it is there, and where it fails. */
  readonly fallback?: ReactNode;
  /** Takes it away again; without it the page cannot be used until it is there. */
  readonly onClose?: (() => void) | undefined;
  readonly children: ReactNode;
}

/** Where its code is missing (after an update of the server) or it fails, a dialog says so and the rest of the page stays. */
export function LazyPart({ fallback = null, onClose, children }: Props) {
  return (
    <CatchBoundary
      getResetKey={() => "part"}
      errorComponent={({ reset }) => (
        <>
          {fallback}
          <PartFailed
            onClose={
              onClose &&
              (() => {
                reset();
                onClose();
              })
            }
          />
        </>
      )}
    >
      <Suspense fallback={fallback}>{children}</Suspense>
    </CatchBoundary>
  );
}

function PartFailed({ onClose }: Pick<Props, "onClose">) {
  return (
    <Modal
      opened
      onClose={onClose ?? (() => undefined)}
      withCloseButton={onClose !== undefined}
      title="This part of the page could not be shown"
    >
      <Text size="sm">
        Ridelab may have been updated since this page was loaded. Loading it again shows what was computed: it is stored
        at this address.
      </Text>
      <Group justify="flex-end" gap="xs" mt="md">
        {onClose && (
          <Button variant="default" onClick={onClose}>
            Close
          </Button>
        )}
        <Button onClick={() => window.location.reload()}>Load again</Button>
      </Group>
    </Modal>
  );
}
