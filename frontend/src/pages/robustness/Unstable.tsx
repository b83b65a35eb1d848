/** Says before everything else that some of what follows is an oscillation. */

import { Alert } from "@mantine/core";
import { IconAlertTriangle } from "../../ui/icons";
import { formatWhole } from "../../units/format";
import type { StudyParts } from "./props";

type Props = Pick<StudyParts, "summary" | "strategies">;

export function Unstable({ summary, strategies }: Props) {
  const sentences = strategies.flatMap(({ id, label }) => {
    const stability = summary.strategies[id]?.stability;
    return stability && stability.unstable > 0
      ? [`${label} is unstable at ${formatWhole(stability.unstable)} of ${formatWhole(stability.known)} points`]
      : [];
  });
  if (sentences.length === 0) return null;
  return (
    <Alert color="red" variant="light" icon={<IconAlertTriangle size={18} />} role="alert" data-testid="unstable">
      {sentences.join("; ")}. There a small disturbance grows until the actuators’ limits stop it: the wheels then
      oscillate by themselves. The figures below include those runs.
    </Alert>
  );
}
