/** Chooses the control for each member of a section. */

import { Stack, Text } from "@mantine/core";
import { memo } from "react";
import { ChoiceFieldRow } from "./ChoiceFieldRow";
import { DataRow } from "./DataRow";
import { NumberFieldRow } from "./NumberFieldRow";
import { RoadClassRow } from "./RoadClassRow";
import { RoadProfileRow } from "./RoadProfileRow";
import type { ChoiceField, Member, NumberField, VectorField } from "../../scenario/schema";
import { useLeaf } from "./useLeaf";
import { WeightsMatrix } from "./WeightsMatrix";

const ROUGHNESS = "/road/roughness";

export const Members = memo(function Members({ members }: { readonly members: readonly Member[] }) {
  const vectors = members.filter((member): member is VectorField => member.kind === "vector");
  return (
    <>
      {vectors.length > 0 && <WeightsMatrix vectors={vectors} />}
      {members.map((member) => (
        <MemberControl key={member.pointer} member={member} />
      ))}
    </>
  );
});

function MemberControl({ member }: { readonly member: Member }) {
  switch (member.kind) {
    case "group":
      return (
        <Stack gap="0.6rem" pt="0.4rem">
          <Text fz="xs" fw={600} c="dimmed">
            {member.title}
          </Text>
          <Members members={member.members} />
        </Stack>
      );
    case "vector":
      return null; // together in one table above
    case "text":
      return <RoadProfileRow field={member} />;
    case "data":
      return <DataRow field={member} />;
    default:
      return <Leaf field={member} />;
  }
}

function Leaf({ field }: { readonly field: NumberField | ChoiceField }) {
  const leaf = useLeaf(field.pointer, field.standard);
  if (field.kind === "choice") return <ChoiceFieldRow {...{ field, leaf }} />;
  return field.pointer === ROUGHNESS ? <RoadClassRow {...{ field, leaf }} /> : <NumberFieldRow {...{ field, leaf }} />;
}
