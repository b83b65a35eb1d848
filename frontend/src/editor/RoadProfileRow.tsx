/** A measured road in place of a made one, opened from a CSV file. */

import { Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { OpenFiles } from "../library/OpenFiles";
import { roadQuery } from "../state/queries";
import classes from "./editor.module.css";
import { FieldFrame } from "./FieldFrame";
import type { TextField } from "./schema";
import { useLeaf } from "./useLeaf";

export function RoadProfileRow({ field }: { readonly field: TextField }) {
  const leaf = useLeaf(field.pointer, field.standard);
  const id = typeof leaf.value === "string" ? leaf.value : "";
  const road = useQuery(roadQuery(id)).data;
  const found = road?.bumps.map(({ start, width, height }) => `${(1000 * height).toFixed(0)} mm at ${start} m over ${width} m`) ?? [];

  return (
    <FieldFrame
      id={`profile-${field.pointer}`}
      {...{ field, leaf }}
      standard="none"
      aside={
        !leaf.readOnly && (
          <OpenFiles name="Road file">Open CSV</OpenFiles>
        )
      }
    >
      {road && (
        <Text className={classes.note}>
          {road.length} m measured, in place of roughness and seed.{" "}
          {found.length > 0 ? `Bumps in it: ${found.join(", ")}.` : "No bump was found in it."}
        </Text>
      )}
    </FieldFrame>
  );
}
