/** The weight tuner: puts a tuning together, or shows one. */

import { Anchor, Skeleton, Text } from "@mantine/core";
import { useDocumentTitle } from "@mantine/hooks";
import { Link, useParams } from "@tanstack/react-router";
import { useMemo } from "react";
import { usePageScenario } from "../origin/origin";
import { CouldNotLoad } from "../shell/Blank";
import { useCatalogues } from "../state/useCatalogues";
import { NewTuning } from "./NewTuning";
import { TuningList } from "./TuningList";
import { TuningPage } from "./TuningPage";
import classes from "./tuner.module.css";
import ui from "../ui/ui.module.css";

/** What both views need of the server: as figures only those that are numbers. */
function useNumericCatalogues() {
  const { catalogues, fault } = useCatalogues();
  const data = useMemo(() => catalogues && { ...catalogues, figures: catalogues.figures.filter(({ key }) => key !== "events.target_reached") }, [catalogues]);
  return { data, fault };
}

function Frame({ fault, children }: { readonly fault: Error | null; readonly children: React.ReactNode }) {
  return (
      <main className={ui.main}>
        {fault ? (
          <CouldNotLoad message={fault.message} />
        ) : (
          children
        )}
      </main>
  );
}

export function OneTuningPage() {
  const { id } = useParams({ from: "/tuner/$id" });
  const { data, fault } = useNumericCatalogues();
  return (
    <Frame fault={fault}>
      <Anchor size="sm" renderRoot={(props) => <Link to="/tuner" {...props} />}>
        New tuning, earlier tunings
      </Anchor>
      <TuningPage key={id} id={id} catalogues={data} />
    </Frame>
  );
}

export function TunerPage() {
  const { data, fault } = useNumericCatalogues();
  const source = usePageScenario();
  useDocumentTitle("Weight tuner · Ridelab");
  return (
    <Frame fault={fault}>
      <h1 className={ui.title}>Weight tuner</h1>
      <Text className={ui.lead ?? ""}>
        Searches the weights of a strategy that minimise an objective on a few training roads: the paper’s normalised sum (Eq. 16), peaks, or any figure, within limits. Several
        objectives give a Pareto front. The paper’s weights are the first trial. At the end the best ones are compared with
        them on validation roads: this shows weights that fit only the training roads.
      </Text>
      {data ? (
        <div className={classes.columns}>
          <NewTuning {...data} source={source} />
          <TuningList {...data} />
        </div>
      ) : (
        <div className={classes.columns} aria-busy aria-label="Loading the form">
          <Skeleton height={620} radius={8} />
          <Skeleton height={220} radius={8} />
        </div>
      )}
    </Frame>
  );
}
