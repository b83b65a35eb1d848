/** A controller or the vehicle as an FMU, which Simulink, CarMaker and Modelica tools import. */

import { Button, Group, Modal, SegmentedControl, Select, Text } from "@mantine/core";
import { useMutation } from "@tanstack/react-query";
import { useState } from "react";
import { askFile } from "../../api/http";
import { explain } from "../../api/problem";
import type { FmuRequest, Scenario, Strategy } from "../../api/types";
import { labelled } from "../../ui/Entry";
import { Fault } from "../../ui/Messages";
import { saveAs } from "./useController";

const VEHICLE = "vehicle" as const;
const VERSIONS = ["2.0", "3.0"] as const;

interface Props {
  readonly strategies: readonly Strategy[];
  /** The strategy that is asked about first. */
  readonly first: string | undefined;
  readonly scenario: () => Scenario;
  readonly onClose: () => void;
}

export function FmuDialog({ strategies, first, scenario, onClose }: Props) {
  const [what, setWhat] = useState<string>(first ?? VEHICLE);
  const [version, setVersion] = useState<NonNullable<FmuRequest["version"]>>("2.0");
  const file = useMutation({
    mutationFn: () => {
      const of = what === VEHICLE ? { of: VEHICLE } : { strategy: what };
      return askFile("post", "/fmus", { body: { scenario: scenario(), version, ...of } }, (response) =>
        response.blob(),
      );
    },
    onSuccess: (fmu) => saveAs(fmu, `ridelab-${what}.fmu`),
  });
  const change = (to: () => void) => {
    file.reset();
    to();
  };
  return (
    <Modal opened onClose={onClose} title="Export an FMU">
      <Text c="dimmed" size="sm">
        For co-simulation in Simulink, CarMaker, Modelica tools and Python, with the C sources and programs for Linux,
        Windows and macOS as far as the service can compile them. The first one may take a minute.
      </Text>
      <Group gap="xs" align="flex-end" my="sm">
        <Select
          label="What"
          w={260}
          allowDeselect={false}
          data={[
            { group: "Controller of", items: labelled(strategies) },
            { group: "Or", items: [{ value: VEHICLE, label: "The vehicle" }] },
          ]}
          value={what}
          onChange={(value) => value !== null && change(() => setWhat(value))}
        />
        <SegmentedControl
          aria-label="Version of FMI"
          data={VERSIONS.map((value) => ({ value, label: `FMI ${value}` }))}
          value={version}
          onChange={(value) => change(() => setVersion(value === "3.0" ? "3.0" : "2.0"))}
        />
      </Group>
      {file.error && <Fault>{explain(file.error)}</Fault>}
      <Group justify="flex-end" gap="xs" mt="sm">
        <Button size="sm" onClick={onClose}>
          Close
        </Button>
        <Button size="sm" variant="filled" loading={file.isPending} onClick={() => file.mutate()}>
          Export
        </Button>
      </Group>
    </Modal>
  );
}
