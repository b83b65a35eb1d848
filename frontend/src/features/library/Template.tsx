/** A road's file to fill in. */

import { Anchor } from "@mantine/core";
import { download } from "../../lib/download";
import { TEMPLATE } from "./columns";

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
