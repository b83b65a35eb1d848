/** All sweeps there are. */

import { useQuery } from "@tanstack/react-query";
import { LabLink } from "../shell/LabLink";
import { Page } from "../shell/Page";
import { strategiesQuery } from "../state/queries";
import { SweepList } from "./SweepList";

export function SweepsPage() {
  const { data: strategies, error } = useQuery(strategiesQuery);
  const lead = (
    <>
      Many variants of one scenario, each under the same strategies. <LabLink size="sm">The lab</LabLink> starts one over the scenario it shows: “Sweep…”, at its top.
    </>
  );
  return (
    <Page title="Sweeps" heading="Sweeps" what="page" faults={[error]} heights={[240]} lead={lead}>
      {strategies ? <SweepList strategies={strategies} /> : null}
    </Page>
  );
}
