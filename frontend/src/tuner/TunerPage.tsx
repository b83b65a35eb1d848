/** The weight tuner: puts a tuning together, or shows one. */

import { Anchor, Button, Skeleton, Text } from "@mantine/core";
import { useDocumentTitle } from "@mantine/hooks";
import { useQuery, useQueryClient } from "@tanstack/react-query";
import { useMemo } from "react";
import { isTransient } from "../api/problem";
import { figuresOf } from "../batch/figures";
import { usePageScenario } from "../origin/origin";
import type { PageProps } from "../pages";
import { Blank } from "../shell/Blank";
import { ConnectionBanner } from "../shell/ConnectionBanner";
import { PageHeader } from "../shell/PageHeader";
import shell from "../shell/shell.module.css";
import { catalogueQuery, figuresQuery, schemaQuery, strategiesQuery } from "../state/queries";
import { NewTuning } from "./NewTuning";
import { TuningList } from "./TuningList";
import { TuningPage } from "./TuningPage";
import classes from "./tuner.module.css";

export function TunerPage({ id }: PageProps) {
  const ground = useGround();
  return id === null ? <Tuner ground={ground} /> : <OneTuning id={id} ground={ground} />;
}

type Ground = ReturnType<typeof useGround>;

/** What both views need of the server. */
function useGround() {
  const schema = useQuery(schemaQuery);
  const strategies = useQuery(strategiesQuery);
  const catalogue = useQuery(catalogueQuery);
  const templates = useQuery(figuresQuery);
  const data = useMemo(() => {
    if (!schema.data || !strategies.data || !catalogue.data || !templates.data) return null;
    const flags = catalogue.data.events.filter(({ key }) => key === "target_reached").map(({ key }) => `events.${key}`);
    const figures = figuresOf(catalogue.data, templates.data).filter(({ key }) => !flags.includes(key));
    return { form: schema.data, strategies: strategies.data, catalogue: catalogue.data, figures };
  }, [schema.data, strategies.data, catalogue.data, templates.data]);
  const fault = [schema, strategies, catalogue, templates].find(({ error }) => error !== null && !isTransient(error))?.error ?? null;
  return { data, fault };
}

function Frame({ run = null, fault, children }: { readonly run?: string | null; readonly fault: Error | null; readonly children: React.ReactNode }) {
  const queries = useQueryClient();
  return (
    <div className={shell.shell}>
      <PageHeader run={run} />
      <main className={classes.main}>
        {fault ? (
          <Blank title="This page could not be shown" text={fault.message}>
            <Button onClick={() => void queries.refetchQueries()}>Try again</Button>
          </Blank>
        ) : (
          children
        )}
      </main>
      <div className={shell.notices} style={{ left: 0 }}>
        <ConnectionBanner />
      </div>
    </div>
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
          <NewTuning form={data.form} catalogue={data.catalogue} strategies={data.strategies} figures={data.figures} source={source} />
          <TuningList strategies={data.strategies} figures={data.figures} />
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
