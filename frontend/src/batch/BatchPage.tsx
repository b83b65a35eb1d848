/** A sweep: how far it is, its plot and its rows. */

import { useDocumentTitle } from "@mantine/hooks";
import { useParams } from "@tanstack/react-router";
import { useMemo } from "react";
import { isNotFound, isTransient } from "../api/problem";
import type { Link } from "../api/types";
import { BATCH, useJob } from "../jobs/useJob";
import { markersOf } from "../plots/markers";
import { LabLink } from "../shell/LabLink";
import { ShellSlot } from "../shell/slots";
import shell from "../shell/shell.module.css";
import { useCatalogues } from "../state/useCatalogues";
import { BatchActions } from "./BatchActions";
import { BatchResults } from "./BatchResults";
import { BatchState } from "./BatchState";
import { SharedNote } from "../share/SharedNote";
import { SweepList } from "./SweepList";
import { titleOf } from "./title";
import { useBatchView, useSharedView, type BatchView } from "./view";
import ui from "../ui/ui.module.css";
import { Loading } from "../ui/Loading";
import { Blank, CouldNotLoad } from "../shell/Blank";

export function SweepPage() {
  const { id } = useParams({ from: "/b/$id" });
  const [view, onView] = useBatchView();
  return <Sweep key={id} {...{ id, view, onView }} />;
}

/** Where a link shows it. */
export function SharedSweep({ id, link }: { readonly id: string; readonly link: Link }) {
  const [view, onView] = useSharedView(link.view);
  return <Sweep {...{ id, link, view, onView }} />;
}

interface Props {
  readonly id: string;
  readonly view: BatchView;
  readonly onView: (change: Partial<BatchView>) => void;
  readonly link?: Link;
}

function Sweep({ id, view, onView, link }: Props) {
  const { job: batch, error, connected, left } = useJob(BATCH, id);
  const { catalogues, fault: catalogueFault } = useCatalogues();
  const title = batch ? (batch.label ?? `Sweep of ${titleOf(batch.fields)}`) : "Sweep";
  useDocumentTitle(`${title} · Ridelab`);

  const strategies = catalogues?.strategies;
  const swept = useMemo(() => strategies?.filter(({ id: strategy }) => batch?.strategies.some((each) => each === strategy)) ?? [], [strategies, batch?.strategies]);
  const markers = useMemo(() => markersOf(strategies ?? []), [strategies]);
  const fault = error !== null && !isTransient(error) ? error : catalogueFault;

  return (
    <>
      <ShellSlot name="tools">
        <span className={shell.grow} />
        <BatchActions batch={batch} view={view} />
      </ShellSlot>
      <main className={ui.main}>
        {link && <SharedNote link={link} what="sweep" />}
        {fault ? (
          isNotFound(error) ? (
            <Blank title="There is no sweep at this address" text="The address may be incomplete, or the sweep was made on another server.">
              <LabLink>Go to the lab</LabLink>
            </Blank>
          ) : <CouldNotLoad what="sweep" message={fault.message} />
        ) : batch && catalogues ? (
          <>
            <h1 className={ui.title}>{title}</h1>
            <BatchState {...{ batch, connected, left }} form={catalogues.form} readOnly={link !== undefined} />
            <BatchResults {...{ batch, markers, view }} {...catalogues} strategies={swept} onView={onView} />
            {!link && <SweepList strategies={catalogues.strategies} current={id} />}
          </>
        ) : (
          <Loading label="Loading the sweep" heights={[28, 96, 440, 320]} />
        )}
      </main>
    </>
  );
}
