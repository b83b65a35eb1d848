/** A road's file to fill in. */

import { Anchor } from "@mantine/core";
import { download } from "../../lib/download";

const TEMPLATE = `# A measured road: one line for each place, in order, at most 5 m apart; the road from 5 m to 3 km long.
# Units are m, km, cm, mm, um, ft or in. One height in place of two: distance [m],height [mm]
distance [m],left [mm],right [mm]
${Array.from({ length: 61 }, (_, index) => {
  const hump = index > 20 && index < 40 ? 20 * (1 - Math.cos((Math.PI * (index - 20)) / 10)) : 0;
  return `${(index / 5).toFixed(1)},${hump.toFixed(1)},${(hump + (index % 3)).toFixed(1)}`;
}).join("\n")}
`;

export function Template() {
  const save = () => {
    const address = URL.createObjectURL(new Blob([TEMPLATE], { type: "text/csv" }));
    download(address, "road-template.csv");
    URL.revokeObjectURL(address);
  };
  return (
    <Anchor component="button" type="button" fz="xs" onClick={save}>
      A road’s template to fill in
    </Anchor>
  );
}
