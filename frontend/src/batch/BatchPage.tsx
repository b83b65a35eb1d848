/** A sweep: how far it is, its plot and its rows. */

import { Text } from "@mantine/core";
import { useDocumentTitle } from "@mantine/hooks";
import { useQuery, useQueryClient } from "@tanstack/react-query";
import { useMemo } from "react";
import { isNotFound, isTransient } from "../api/problem";
import type { Link } from "../api/types";
import { BATCH, useJob } from "../jobs/useJob";
import { markersOf } from "../plots/markers";
import { ConnectionBanner } from "../shell/ConnectionBanner";
import shell from "../shell/shell.module.css";
import { catalogueQuery, figuresQuery, schemaQuery, strategiesQuery } from "../state/queries";
import { BatchFault, BatchLoading, NoBatch } from "./BatchBlank";
import { BatchHeader } from "./BatchHeader";
import { BatchResults } from "./BatchResults";
import { BatchState } from "./BatchState";
import classes from "./batch.module.css";
import { figuresOf } from "./figures";
import { SharedBatchBanner } from "./SharedBatchBanner";
import { SweepList, titleOf } from "./SweepList";
import { useBatchView } from "./view";

interface Props {
  readonly id: string;
  /** Where the page was opened by a link. */
  readonly link?: Link;
}

export function BatchPage({ id, link }: Props) {
  const queries = useQueryClient();
  const { job: batch, error, connected, left } = useJob(BATCH, id);
  const strategies = useQuery(strategiesQuery);
  const catalogue = useQuery(catalogueQuery);
  const templates = useQuery(figuresQuery);
  const form = useQuery(schemaQuery);
  const [view, setView] = useBatchView(link?.view);
  const title = batch ? (batch.label ?? `Sweep of ${titleOf(batch.fields)}`) : "Sweep";
  useDocumentTitle(`${title} · Ridelab`);

  const figures = useMemo(() => (catalogue.data && templates.data ? figuresOf(catalogue.data, templates.data) : null), [catalogue.data, templates.data]);
  const swept = useMemo(() => (strategies.data ?? []).filter(({ id: strategy }) => batch?.strategies.some((each) => each === strategy)), [strategies.data, batch?.strategies]);
  const markers = useMemo(() => markersOf(strategies.data ?? []), [strategies.data]);
  const fault = [error, strategies.error, catalogue.error, templates.error, form.error].find((each) => each !== null && !isTransient(each));

  return (
    <div className={shell.shell}>
      <BatchHeader batch={batch} view={view} />
      <main className={classes.main}>
        {link && <SharedBatchBanner link={link} />}
        {fault ? (
          isNotFound(error) ? <NoBatch /> : <BatchFault message={fault.message} onRetry={() => void queries.refetchQueries()} />
        ) : batch && figures && catalogue.data && form.data && strategies.data ? (
          <>
            <Text component="h2" className={classes.title}>
              {title}
            </Text>
            <BatchState {...{ batch, connected, left }} form={form.data} readOnly={link !== undefined} />
            <BatchResults {...{ batch, figures, markers, view }} catalogue={catalogue.data} strategies={swept} onView={setView} />
            {!link && <SweepList strategies={strategies.data} current={id} />}
          </>
        ) : (
          <BatchLoading />
        )}
      </main>
      <div className={shell.notices} style={{ left: 0 }}>
        <ConnectionBanner />
      </div>
    </div>
  );
}
