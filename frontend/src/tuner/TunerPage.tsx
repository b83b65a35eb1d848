/** The weight tuner: puts a tuning together, or shows one. */

import { Anchor, Button, Skeleton, Text } from "@mantine/core";
import { useDocumentTitle } from "@mantine/hooks";
import { useQueryClient } from "@tanstack/react-query";
import { useMemo } from "react";
import { usePageScenario } from "../origin/origin";
import type { PageProps } from "../pages";
import { Blank } from "../shell/Blank";
import { Page } from "../shell/Page";
import { useCatalogues } from "../state/useCatalogues";
import { NewTuning } from "./NewTuning";
import { TuningList } from "./TuningList";
import { TuningPage } from "./TuningPage";
import classes from "./tuner.module.css";

export function TunerPage({ id }: PageProps) {
  const ground = useGround();
  return id === null ? <Tuner ground={ground} /> : <OneTuning id={id} ground={ground} />;
}

type Ground = ReturnType<typeof useGround>;

/** What both views need of the server: as figures only those that are numbers. */
function useGround() {
  const { catalogues, fault } = useCatalogues();
  const data = useMemo(() => catalogues && { ...catalogues, figures: catalogues.figures.filter(({ key }) => key !== "events.target_reached") }, [catalogues]);
  return { data, fault };
}

function Frame({ run = null, fault, children }: { readonly run?: string | null; readonly fault: Error | null; readonly children: React.ReactNode }) {
  const queries = useQueryClient();
  return (
    <Page run={run}>
      <main className={classes.main}>
        {fault ? (
          <Blank title="This page could not be shown" text={fault.message}>
            <Button onClick={() => void queries.refetchQueries()}>Try again</Button>
          </Blank>
        ) : (
          children
        )}
      </main>
    </Page>
  );
}

function OneTuning({ id, ground: { data, fault } }: { readonly id: string; readonly ground: Ground }) {
  return (
    <Frame fault={fault}>
      <Anchor href="/tuner" size="sm">
        New tuning, earlier tunings
      </Anchor>
      <TuningPage id={id} ground={data} />
    </Frame>
  );
}

function Tuner({ ground: { data, fault } }: { readonly ground: Ground }) {
  const source = usePageScenario();
  useDocumentTitle("Weight tuner · Ridelab");
  return (
    <Frame run={source.origin.run} fault={fault}>
      <h1 className={classes.heading}>Weight tuner</h1>
      <Text className={classes.lead ?? ""}>
        Searches the weights of a strategy that minimise an objective on a few training roads: the paper’s normalised sum (Eq. 16), peaks, or any figure, within limits. Several
        objectives give a Pareto front. The paper’s weights are always the first trial, and at the end it is compared with the best ones on validation roads, which shows weights that fit single roads only.
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
