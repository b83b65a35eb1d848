/** All sweeps there are. */

import { Text } from "@mantine/core";
import { useDocumentTitle } from "@mantine/hooks";
import { useQuery } from "@tanstack/react-query";
import { isTransient } from "../api/problem";
import { LabLink } from "../shell/LabLink";
import { CouldNotLoad } from "../shell/Blank";
import { strategiesQuery } from "../state/queries";
import { Loading } from "../ui/Loading";
import ui from "../ui/ui.module.css";
import { SweepList } from "./SweepList";

export function SweepsPage() {
  const { data: strategies, error } = useQuery(strategiesQuery);
  useDocumentTitle("Sweeps · Ridelab");
  return (
    <main className={ui.main}>
      <h1 className={ui.title}>Sweeps</h1>
      <Text className={ui.lead ?? ""}>
        Many variants of one scenario, each under the same strategies. <LabLink size="sm">The lab</LabLink> starts one over the scenario it shows: “Sweep…”, at its top.
      </Text>
      {strategies ? (
        <SweepList strategies={strategies} />
      ) : error && !isTransient(error) ? (
        <CouldNotLoad message={error.message} />
      ) : (
        <Loading label="Loading the sweeps" heights={[240]} />
      )}
    </main>
  );
}
