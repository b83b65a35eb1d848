/** The C sources of this scenario's controller, as a zip. */

import { Button, Group, Text } from "@mantine/core";
import { IconDownload } from "../../ui/icons";
import type { Scenario } from "../../api/types";
import { useController } from "../../features/export/useController";
import { Fault } from "../../ui/Fault";

export function ExportController({ scenario }: { readonly scenario: Scenario | undefined }) {
  const { save, saving, error } = useController();
  return (
    <Group gap="xs">
      <Button
        size="xs"
        variant="default"
        leftSection={<IconDownload size={15} />}
        loading={saving}
        disabled={!scenario}
        onClick={() => scenario && save(scenario)}
      >
        Export controller (C)
      </Button>
      <Text size="xs" c="dimmed">
        A zip: the tables for this scenario, the C99 program without dynamic memory, a Makefile and how to build it,
        with any C compiler.
      </Text>
      {error && <Fault>It could not be exported: {error.message}</Fault>}
    </Group>
  );
}
