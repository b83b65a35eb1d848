/** Asks what the columns of a road's file are before it is sent. */

import { useSelector } from "@tanstack/react-store";
import { messageOf } from "../../api/problem";
import { columnsOf, type Layout, type Table, type Use } from "../mapping/columns";
import { MappingDialog } from "../mapping/MappingDialog";
import { unclear, useOpenFiles } from "./open";
import { ProfileSketch } from "./ProfileSketch";
import { Template } from "./Template";
import { METRES, ROAD_ROLES, roadFault, roadPlaces } from "./roadFile";

export function RoadMapping() {
  const [file] = useSelector(unclear);
  const openFiles = useOpenFiles();
  if (!file) return null;
  const next = () => unclear.set(unclear.get().slice(1));
  const open = async (csv: string) => {
    try {
      const wrong = await openFiles([new File([csv], file.name)]);
      if (wrong === null) next();
      return wrong;
    } catch (error) {
      return messageOf(error);
    }
  };
  return (
    <MappingDialog
      key={file.name}
      title={`Columns of ${file.name}`}
      text={file.text}
      roles={ROAD_ROLES}
      places={roadPlaces}
      faultOf={roadFault}
      picture={(table, uses, layout) => <Picture {...{ table, uses, layout }} />}
      action="Drive this road"
      onMapped={open}
      onClose={next}
      aside={<Template />}
    />
  );
}

interface PictureProps {
  readonly table: Table;
  readonly uses: readonly Use[];
  readonly layout: Layout;
}

function Picture({ table, uses, layout }: PictureProps) {
  const columns = columnsOf(table, uses, layout.decimalComma);
  const metres = ({ role, unit }: Use) => (columns.get(role) ?? []).map((value) => value * (METRES[unit] ?? 1));
  const distance = uses.find(({ role }) => role === "distance");
  const heights = uses.filter(({ role }) => role !== "" && role !== "distance");
  return (
    <ProfileSketch
      label="The road as it is read"
      distance={distance ? metres(distance) : []}
      tracks={heights.map(metres)}
    />
  );
}
