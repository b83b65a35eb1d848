/** A sweep: how far it is, its plot and its rows. */

import { useParams } from "@tanstack/react-router";
import { useMemo } from "react";
import type { Link } from "../../api/types";
import { BATCH, useJob } from "../../jobs/useJob";
import { markersOf } from "../../plots/markers";
import { LabLink } from "../../ui/LabLink";
import { Page } from "../../ui/Page";
import { useCatalogues } from "../../server/useCatalogues";
import { BatchActions } from "./SweepActions";
import { BatchResults } from "./SweepResults";
import { BatchState } from "../../features/sweep/SweepState";
import { SharedNote } from "../../features/share/SharedNote";
import { SweepList } from "../../features/sweep/SweepList";
import { titleOf } from "../../features/sweep/title";
import { useBatchView, useSharedView, type BatchView } from "./view";

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
  const title = batch && (batch.label ?? `Sweep of ${titleOf(batch.fields)}`);
  const strategies = catalogues?.strategies;
  const swept = useMemo(
    () => strategies?.filter(({ id: strategy }) => batch?.strategies.some((each) => each === strategy)) ?? [],
    [strategies, batch?.strategies],
  );
  const markers = useMemo(() => markersOf(strategies ?? []), [strategies]);
  return (
    <Page
      title={title ?? "Sweep"}
      heading={catalogues ? title : undefined}
      above={link && <SharedNote link={link} what="sweep" />}
      tools={<BatchActions batch={batch} view={view} />}
      what="sweep"
      instead={<LabLink>Go to the lab</LabLink>}
      faults={[error, catalogueFault]}
      heights={[28, 96, 440, 320]}
    >
      {batch && catalogues ? (
        <>
          <BatchState {...{ batch, connected, left }} form={catalogues.form} readOnly={link !== undefined} />
          <BatchResults {...{ batch, markers, view }} {...catalogues} strategies={swept} onView={onView} />
          {!link && <SweepList strategies={catalogues.strategies} current={id} />}
        </>
      ) : null}
    </Page>
  );
}
