/** Which vehicle it is: one with sources, one of the library, or values of one's own; and the vehicle as a file. */

import { Box, Button, Group as Row, Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import type { JsonObject } from "../../api/types";
import { useExportItem } from "../library/open";
import { OpenFiles } from "../library/OpenFiles";
import { dialog, useItems } from "../../scenario/library";
import { useEdit, useFromScenario, useLab, useReadOnly } from "../../lab/context";
import { vehiclesQuery } from "../../server/queries";
import { completed } from "../../scenario/differences";
import { getAt, sameValue, setAt, type Pointer } from "../../scenario/path";
import type { Group } from "../../scenario/schema";
import { CharacteristicsTable } from "./CharacteristicsTable";
import { useActionButton } from "../../lab/actions";
import { Choice, labelled } from "../../ui/Entry";

/** Those with sources, and those of the library. */
export function useVehicles() {
  const sourced = useQuery(vehiclesQuery).data ?? [];
  const own = useItems("vehicle").map(({ name, value }) => ({ id: `own ${name}`, label: name, vehicle: value }));
  return { sourced, own };
}

const PAPER = { id: "paper", label: "The paper\u2019s", vehicle: {} };
const OTHER = "";

export function VehicleChoice({ group }: { readonly group: Group }) {
  const edit = useEdit();
  const exportItem = useExportItem();
  const readOnly = useReadOnly();
  const vehicle = useFromScenario((scenario) => getAt(scenario, group.pointer));
  const { sourced, own } = useVehicles();
  const whole = (values: JsonObject) => getAt(completed(group, { vehicle: values }), group.pointer);
  const choices = [PAPER, ...sourced, ...own];
  const current = choices.find((each) => sameValue(whole(each.vehicle), vehicle));
  const source = sourced.find((each) => each === current);

  const choose = (id: string) => {
    const choice = choices.find((each) => each.id === id);
    const next = choice && whole(choice.vehicle);
    if (next !== undefined && !sameValue(next, vehicle)) edit.commit(setAt(edit.newest(), group.pointer, next));
  };
  const save = () =>
    void exportItem({ kind: "vehicle", name: current?.label ?? "Own vehicle", value: vehicle as JsonObject });

  return (
    <Row gap="0.4rem">
      <Choice
        aria-label="Vehicle"
        flex="1 1 8rem"
        value={current?.id ?? OTHER}
        disabled={readOnly}
        data={[
          ...(current ? [] : [{ value: OTHER, label: "Own values" }]),
          ...labelled([PAPER, ...sourced]),
          ...(own.length > 0 ? [{ group: "Your vehicles", items: labelled(own) }] : []),
        ]}
        onPick={choose}
      />
      {!readOnly && <DataSheetButton />}
      {!readOnly && (
        <OpenFiles name="Vehicle file" wanted="vehicle">
          Open file
        </OpenFiles>
      )}
      <Button size="compact-xs" onClick={save}>
        Save file
      </Button>
      {!readOnly && (
        <Button size="compact-xs" onClick={() => dialog.set("vehicle")}>
          Save in the library
        </Button>
      )}
      {source && (
        <Text size="xs" mt={4} c="dimmed" title={source.sources.join("\n")}>
          {source.description} {source.sources[0]}
        </Text>
      )}
      <VehicleFacts pointer={group.pointer} />
    </Row>
  );
}

function DataSheetButton() {
  const { label, ...button } = useActionButton("dataSheet");
  return (
    <Button size="compact-xs" {...button}>
      {label}
    </Button>
  );
}

/** What the vehicle’s values come to: of the newest answer, which is of the values before while a slider moves on. */
function VehicleFacts({ pointer }: { readonly pointer: Pointer }) {
  const of = useLab(({ shown }) => shown?.characteristics);
  const clearance = useFromScenario((scenario) => getAt(scenario, `${pointer}/bump_stop_clearance`));
  if (!of) return null;
  return (
    <Box flex="1 0 calc(100% + 1.8rem)" mx="-0.9rem">
      <CharacteristicsTable of={of} clearance={typeof clearance === "number" ? clearance : null} />
    </Box>
  );
}
