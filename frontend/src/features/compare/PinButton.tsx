/** Keeps the shown result under a name, beside whatever comes next. */

import { Button, Tooltip } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { changedFields, changesText } from "../../scenario/differences";
import { IconPin } from "../../ui/icons";
import { useLabContext, useLab } from "../../lab/context";
import { defaultName, MOST_PINS } from "../../lab/pins";
import { schemaQuery } from "../../server/queries";
import { useStore } from "../../lib/store";
import { ownPins } from "./usePins";

export function PinButton() {
  const { lab, standard } = useLabContext();
  const form = useQuery(schemaQuery).data;
  const pins = useStore(ownPins);
  const run = useLab(({ shown, stale, shared }) =>
    shown?.source === "exact" && !stale && !shared ? shown.runId : null,
  );
  const isPinned = pins.some((pin) => pin.run === run);
  const isFull = pins.length >= MOST_PINS;
  const pin = () => {
    const { shown } = lab.get();
    if (run === null || !shown || !form) return;
    const differs = changesText(changedFields(form, standard, shown.scenario), 2) || "Paper’s scenario";
    ownPins.add({ name: defaultName(differs, pins), run });
  };
  const why = isPinned
    ? "Pinned: compared with whatever comes next"
    : isFull
      ? `At most ${MOST_PINS} results are pinned`
      : "Keeps this result here, to compare others with it";
  return (
    <Tooltip label={why} multiline w={240} openDelay={500}>
      <Button
        size="xs"
        variant="default"
        leftSection={<IconPin size={15} />}
        disabled={run === null || isPinned || isFull || !form}
        onClick={pin}
      >
        Pin
      </Button>
    </Tooltip>
  );
}
