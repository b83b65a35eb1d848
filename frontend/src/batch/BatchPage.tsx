/** A sweep: how far it is, its plot and its rows. */

import { useDocumentTitle } from "@mantine/hooks";
import { useMemo } from "react";
import { isNotFound, isTransient } from "../api/problem";
import type { Link } from "../api/types";
import { BATCH, useJob } from "../jobs/useJob";
import { markersOf } from "../plots/markers";
import { Page } from "../shell/Page";
import { useCatalogues } from "../state/useCatalogues";
import { BatchActions } from "./BatchActions";
import { BatchResults } from "./BatchResults";
import { BatchState } from "./BatchState";
import { SharedNote } from "../share/SharedNote";
import { SweepList, titleOf } from "./SweepList";
import { useBatchView } from "./view";
import ui from "../ui/ui.module.css";
import { Loading } from "../ui/Loading";
import { Blank, CouldNotLoad } from "../shell/Blank";
import { Anchor } from "@mantine/core";

interface Props {
  readonly id: string;
  /** Where the page was opened by a link. */
  readonly link?: Link;
}

export function BatchPage({ id, link }: Props) {
  const { job: batch, error, connected, left } = useJob(BATCH, id);
  const { catalogues, fault: catalogueFault } = useCatalogues();
  const [view, setView] = useBatchView(link?.view);
  const title = batch ? (batch.label ?? `Sweep of ${titleOf(batch.fields)}`) : "Sweep";
  useDocumentTitle(`${title} · Ridelab`);

  const strategies = catalogues?.strategies;
  const swept = useMemo(() => strategies?.filter(({ id: strategy }) => batch?.strategies.some((each) => each === strategy)) ?? [], [strategies, batch?.strategies]);
  const markers = useMemo(() => markersOf(strategies ?? []), [strategies]);
  const fault = error !== null && !isTransient(error) ? error : catalogueFault;

  return (
    <Page actions={<BatchActions batch={batch} view={view} />}>
      <main className={ui.main}>
        {link && <SharedNote link={link} what="sweep" />}
        {fault ? (
          isNotFound(error) ? (
            <Blank title="There is no sweep at this address" text="The address may be cut short, or the sweep was made on another server.">
              <Anchor href="/">Open the paper’s scenario</Anchor>
            </Blank>
          ) : <CouldNotLoad what="sweep" message={fault.message} />
        ) : batch && catalogues ? (
          <>
            <h1 className={ui.title}>{title}</h1>
            <BatchState {...{ batch, connected, left }} form={catalogues.form} readOnly={link !== undefined} />
            <BatchResults {...{ batch, markers, view }} {...catalogues} strategies={swept} onView={setView} />
            {!link && <SweepList strategies={catalogues.strategies} current={id} />}
          </>
        ) : (
          <Loading label="Loading the sweep" heights={[28, 96, 440, 320]} />
        )}
      </main>
    </Page>
  );
}
