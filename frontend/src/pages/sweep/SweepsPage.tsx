/** All sweeps there are. */

import { useQuery } from "@tanstack/react-query";
import { LabLink } from "../../ui/LabLink";
import { Page } from "../../ui/Page";
import { strategiesQuery } from "../../server/queries";
import { SweepList } from "../../features/sweep/SweepList";

export function SweepsPage() {
  const { data: strategies, error } = useQuery(strategiesQuery);
  const lead = (
    <>
      Many variants of one scenario, each under the same strategies. <LabLink size="sm">The lab</LabLink> starts one
      over the scenario it shows: “Sweep…”, at its top.
    </>
  );
  return (
    <Page title="Sweeps" heading="Sweeps" what="page" faults={[error]} heights={[240]} lead={lead}>
      {strategies ? <SweepList strategies={strategies} /> : null}
    </Page>
  );
}
