/** A sweep: how far it is, its plot and its rows. */

import { useDocumentTitle } from "@mantine/hooks";
import { useQueryClient } from "@tanstack/react-query";
import { useMemo } from "react";
import { isNotFound, isTransient } from "../api/problem";
import type { Link } from "../api/types";
import { BATCH, useJob } from "../jobs/useJob";
import { markersOf } from "../plots/markers";
import { Page } from "../shell/Page";
import { useCatalogues } from "../state/useCatalogues";
import { BatchFault, BatchLoading, NoBatch } from "./BatchBlank";
import { BatchActions } from "./BatchActions";
import { BatchResults } from "./BatchResults";
import { BatchState } from "./BatchState";
import classes from "./batch.module.css";
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
  const { catalogues, fault: missing } = useCatalogues();
  const [view, setView] = useBatchView(link?.view);
  const title = batch ? (batch.label ?? `Sweep of ${titleOf(batch.fields)}`) : "Sweep";
  useDocumentTitle(`${title} · Ridelab`);

  const strategies = catalogues?.strategies;
  const swept = useMemo(() => strategies?.filter(({ id: strategy }) => batch?.strategies.some((each) => each === strategy)) ?? [], [strategies, batch?.strategies]);
  const markers = useMemo(() => markersOf(strategies ?? []), [strategies]);
  const fault = error !== null && !isTransient(error) ? error : missing;

  return (
    <Page actions={<BatchActions batch={batch} view={view} />}>
      <main className={classes.main}>
        {link && <SharedBatchBanner link={link} />}
        {fault ? (
          isNotFound(error) ? <NoBatch /> : <BatchFault message={fault.message} onRetry={() => void queries.refetchQueries()} />
        ) : batch && catalogues ? (
          <>
            <h1 className={classes.title}>{title}</h1>
            <BatchState {...{ batch, connected, left }} form={catalogues.form} readOnly={link !== undefined} />
            <BatchResults {...{ batch, markers, view }} {...catalogues} strategies={swept} onView={setView} />
            {!link && <SweepList strategies={catalogues.strategies} current={id} />}
          </>
        ) : (
          <BatchLoading />
        )}
      </main>
    </Page>
  );
}
