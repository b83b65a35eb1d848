/** A measured road in place of a made one: of the library, or opened from a file; drawn, with the bump that counts; and saved as a file. */

import { Button, NativeSelect, Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { address } from "../../api/http";
import { useOpenItem } from "../library/open";
import { OpenFiles } from "../library/OpenFiles";
import { ProfileSketch } from "../library/ProfileSketch";
import { indicesText, RoadSpectrum } from "../library/RoadSpectrum";
import { useItems } from "../../scenario/library";
import { useEdit, useFromScenario } from "../../lab/context";
import { roadQuery } from "../../server/queries";
import { FieldFrame } from "./FieldFrame";
import { getAt, setAt } from "../../scenario/path";
import { onBump } from "../../scenario/withItem";
import type { TextField } from "../../scenario/schema";
import { useLeaf } from "./useLeaf";

const NONE = { value: "", label: "None" };

export function RoadProfileRow({ field }: { readonly field: TextField }) {
  const leaf = useLeaf(field);
  const edit = useEdit();
  const openItem = useOpenItem();
  const own = useItems("road");
  const id = typeof leaf.value === "string" ? leaf.value : "";
  const road = useQuery(roadQuery(id)).data;
  const bumps = road?.bumps ?? [];
  const labels = bumps.map(
    ({ start, width, height }) => `${(1000 * height).toFixed(0)} mm at ${start} m over ${width} m`,
  );
  const place = useFromScenario((scenario) => getAt(scenario, "/road/bump/start"));
  const counting = bumps.findIndex(({ start }) => Math.max(1, start) === place);
  const saved = own.flatMap(({ name, value }) =>
    typeof value.id === "string" ? [{ value: value.id, label: name }] : [],
  );
  const name = `profile-${field.pointer}`;

  const choose = (value: string) => {
    const item = own.find((each) => each.value.id === value);
    if (item) openItem(item);
    else if (value === "") edit.commit(setAt(edit.newest(), field.pointer, null));
  };

  return (
    <FieldFrame
      id={name}
      {...{ field, leaf }}
      standard="none"
      aside={
        <>
          {road && (
            <Button
              component="a"
              size="compact-xs"
              href={address("/roads/{id}", { path: { id }, query: { format: "csv" } })}
              download={`ridelab-road-${id}.csv`}
            >
              Save CSV
            </Button>
          )}
          {road && (
            <Button
              component="a"
              size="compact-xs"
              href={address("/roads/{id}", { path: { id }, query: { format: "crg" } })}
              download={`ridelab-road-${id}.crg`}
            >
              Save OpenCRG
            </Button>
          )}
          {!leaf.readOnly && <OpenFiles name="Road file">Open file</OpenFiles>}
        </>
      }
    >
      {(own.length > 0 || id !== "") && (
        <NativeSelect
          id={name}
          value={id}
          disabled={leaf.readOnly}
          data={[
            NONE,
            ...(id === "" || saved.some(({ value }) => value === id)
              ? []
              : [{ value: id, label: "A measured road, not in the library" }]),
            ...(saved.length > 0 ? [{ group: "Your measured roads", items: saved }] : []),
          ]}
          onChange={(event) => choose(event.currentTarget.value)}
        />
      )}
      {road && (
        <>
          <ProfileSketch
            label="The road that is driven"
            distance={road.distance}
            tracks={[road.height]}
            marks={bumps.map((bump, index) => ({ ...bump, counts: index === counting }))}
          />
          <Text size="xs" mt={4} c="dimmed">
            {road.length} m measured, in place of roughness and seed.{" "}
            {labels.length > 0 ? `Bumps in it: ${labels.join(", ")}.` : "No bump was found in it."}
          </Text>
          {bumps.length > 1 && (
            <NativeSelect
              label="Bump that counts"
              description="The car brakes for it, and the stages and windows go by it."
              value={counting}
              disabled={leaf.readOnly}
              data={[
                ...(counting < 0 ? [{ value: "-1", label: "None of them" }] : []),
                ...labels.map((label, index) => ({ value: String(index), label })),
              ]}
              onChange={(event) => {
                const bump = bumps[Number(event.currentTarget.value)];
                if (bump) edit.commit(onBump(edit.newest(), road.length, bump));
              }}
            />
          )}
          {indicesText(road) !== null && (
            <>
              <RoadSpectrum road={road} />
              <Text size="xs" mt={4} c="dimmed">
                {indicesText(road)}
              </Text>
            </>
          )}
        </>
      )}
    </FieldFrame>
  );
}
