/** Which vehicle it is: one with sources, one from a file, or values of one's own; and the vehicle as a file. */

import { Button, FileButton, NativeSelect, Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useRef, useState } from "react";
import type { JsonObject } from "../api/types";
import { download } from "../ui/download";
import { useEdit, useFromScenario, useReadOnly } from "../state/context";
import { vehiclesQuery } from "../state/queries";
import { Fault } from "../ui/Fault";
import classes from "./editor.module.css";
import { getAt, sameValue, setAt } from "./path";
import type { Group } from "./schema";
import { readVehicleFile, standardVehicle, vehicleFile } from "./vehicleFile";

const PAPER = "paper";
const OWN = "";

export function VehicleChoice({ group }: { readonly group: Group }) {
  const edit = useEdit();
  const readOnly = useReadOnly();
  const vehicle = useFromScenario((scenario) => getAt(scenario, group.pointer));
  const vehicles = useQuery(vehiclesQuery).data ?? [];
  const [wrong, setWrong] = useState<string | null>(null);
  const resetFile = useRef<() => void>(null);
  const standard = standardVehicle(group);
  const whole = (values: JsonObject) => ({ ...standard, ...values });
  const known = vehicles.find((each) => sameValue(whole(each.vehicle), vehicle));
  const isPaper = sameValue(standard, vehicle);

  const put = (next: JsonObject) => {
    setWrong(null);
    if (!sameValue(next, vehicle)) edit.commit(setAt(edit.newest(), group.pointer, next));
  };
  const choose = (id: string) => {
    const chosen = vehicles.find((each) => each.id === id);
    if (chosen) put(whole(chosen.vehicle));
    else if (id === PAPER) put(standard);
  };
  const read = async (file: File | null) => {
    if (file === null) return;
    resetFile.current?.(); // the same file may be read again
    try {
      put(readVehicleFile(await file.text(), group));
    } catch (error) {
      setWrong(`${file.name}: ${error instanceof Error ? error.message : String(error)}`);
    }
  };
  const save = () => {
    const label = known?.label ?? (isPaper ? "The paper\u2019s" : "Own vehicle");
    const address = URL.createObjectURL(new Blob([vehicleFile(vehicle, label)], { type: "application/json" }));
    download(address, `vehicle-${known?.id ?? (isPaper ? PAPER : "own")}.json`);
    URL.revokeObjectURL(address);
  };

  return (
    <div className={classes.vehicle}>
      <NativeSelect
        size="xs"
        aria-label="Vehicle"
        className={classes.vehicleSelect ?? ""}
        value={known?.id ?? (isPaper ? PAPER : OWN)}
        disabled={readOnly}
        data={[
          ...(known || isPaper ? [] : [{ value: OWN, label: "Own values" }]),
          { value: PAPER, label: "The paper\u2019s" },
          ...vehicles.map(({ id, label }) => ({ value: id, label })),
        ]}
        onChange={(event) => choose(event.currentTarget.value)}
      />
      {!readOnly && (
        <FileButton resetRef={resetFile} accept="application/json,.json" inputProps={{ "aria-label": "Vehicle file" }} onChange={(file) => void read(file)}>
          {(props) => (
            <Button {...props} size="compact-xs" variant="default">
              Open file
            </Button>
          )}
        </FileButton>
      )}
      <Button size="compact-xs" variant="default" onClick={save}>
        Save file
      </Button>
      {known && (
        <Text className={classes.note} title={known.sources.join("\n")}>
          {known.description} {known.sources[0]}
        </Text>
      )}
      {wrong !== null && <Fault>{wrong}</Fault>}
    </div>
  );
}
