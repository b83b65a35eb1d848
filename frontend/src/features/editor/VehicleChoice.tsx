/** Which vehicle it is: one with sources, one of the library, or values of one's own; and the vehicle as a file. */

import { Button, NativeSelect, Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import type { JsonObject } from "../../api/types";
import { useExportItem } from "../library/open";
import { OpenFiles } from "../library/OpenFiles";
import { dialog, useItems } from "../../scenario/library";
import { useEdit, useFromScenario, useReadOnly } from "../../lab/context";
import { vehiclesQuery } from "../../server/queries";
import { completed } from "../../scenario/differences";
import classes from "./editor.module.css";
import { getAt, sameValue, setAt } from "../../scenario/path";
import type { Group } from "../../scenario/schema";

const PAPER = { id: "paper", label: "The paper\u2019s", vehicle: {} };
const OTHER = "";

export function VehicleChoice({ group }: { readonly group: Group }) {
  const edit = useEdit();
  const exportItem = useExportItem();
  const readOnly = useReadOnly();
  const vehicle = useFromScenario((scenario) => getAt(scenario, group.pointer));
  const sourced = useQuery(vehiclesQuery).data ?? [];
  const own = useItems("vehicle").map(({ name, value }) => ({ id: `own ${name}`, label: name, vehicle: value }));
  const whole = (values: JsonObject) => getAt(completed(group, { vehicle: values }), group.pointer);
  const choices = [PAPER, ...sourced, ...own];
  const chosen = choices.find((each) => sameValue(whole(each.vehicle), vehicle));
  const source = sourced.find((each) => each === chosen);
  const option = ({ id, label }: (typeof choices)[number]) => ({ value: id, label });

  const choose = (id: string) => {
    const choice = choices.find((each) => each.id === id);
    const next = choice && whole(choice.vehicle);
    if (next !== undefined && !sameValue(next, vehicle)) edit.commit(setAt(edit.newest(), group.pointer, next));
  };
  const save = () =>
    void exportItem({ kind: "vehicle", name: chosen?.label ?? "Own vehicle", value: vehicle as JsonObject });

  return (
    <div className={classes.vehicle}>
      <NativeSelect
        aria-label="Vehicle"
        flex="1 1 8rem"
        value={chosen?.id ?? OTHER}
        disabled={readOnly}
        data={[
          ...(chosen ? [] : [{ value: OTHER, label: "Own values" }]),
          ...[PAPER, ...sourced].map(option),
          ...(own.length > 0 ? [{ group: "Your vehicles", items: own.map(option) }] : []),
        ]}
        onChange={(event) => choose(event.currentTarget.value)}
      />
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
        <Text className={classes.note} title={source.sources.join("\n")}>
          {source.description} {source.sources[0]}
        </Text>
      )}
    </div>
  );
}
