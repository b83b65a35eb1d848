/** Something to beware of, with its sign. */

import { Group, Text } from "@mantine/core";
import { Icon } from "./icons";

interface Props {
  readonly text: string;
}

export function Caution({ text }: Props) {
  return (
    <Group gap="0.3rem" wrap="nowrap" align="start" c="var(--worse)" data-testid="caution">
      <Icon name="AlertTriangle" size={14} style={{ flex: "none", marginTop: 2 }} />
      <Text size="xs">{text}</Text>
    </Group>
  );
}
