/** A sweep: how far it is, its plot and its rows. */

import { useParams } from "@tanstack/react-router";
import type { Link, Batch, SharedView } from "../../api/types";
import { BATCH, useJob } from "../../jobs/useJob";
import { Page } from "../../ui/Page";
import { BatchResults } from "./SweepResults";
import { BatchState, SweepList } from "../../features/sweep/SweepState";
import { SharedNote } from "../../features/share/SharedBanner";
import { SweepButton } from "../../features/sweep/SweepButton";
import { titleOf } from "../../features/sweep/table";
import { useBatchView, useSharedView, type BatchView } from "./view";
import { ask } from "../../api/http";
import { BatchFiles } from "../../features/export/FileMenu";
import { ShareLink } from "../../features/share/ShareLink";
import { LabLink } from "../../ui/openInLab";

export function SweepPage() {
  const { id } = useParams({ from: "/b/$id" });
  const [view, onView] = useBatchView();
  return <Sweep key={id} {...{ id, view, onView }} />;
}

/** Where a link shows it. */
export function SharedSweep({ batch, link }: { readonly batch: Batch; readonly link: Link }) {
  const [view, onView] = useSharedView(link.view);
  return <Sweep id={batch.id} {...{ link, view, onView }} />;
}

interface Props {
  readonly id: string;
  readonly view: BatchView;
  readonly onView: (change: Partial<BatchView>) => void;
  readonly link?: Link;
}

function Sweep({ id, view, onView, link }: Props) {
  const { job: batch, connected, left } = useJob(BATCH, id, link?.batch ?? undefined);
  return (
    <Page
      title={batch.label ?? (batch.total > 0 ? `Sweep of ${titleOf(batch.fields)}` : "Sweep")}
      above={link && <SharedNote link={link} what="sweep" />}
      tools={
        <>
          <SweepButton batch={batch} />
          <ShareLink
            make={() => ask("post", "/links", { body: { batch_id: batch.id, view: toShare(batch, view) } })}
            obstacle={null}
            opens="It opens this sweep with its plot as it is here, for anyone who has the link. It is read-only."
          />
          <BatchFiles batch={batch} />
        </>
      }
    >
      <BatchState {...{ batch, connected, left }} readOnly={link !== undefined} />
      <BatchResults {...{ batch, view, onView }} />
      {!link && <SweepList current={id} />}
    </Page>
  );
}

/** How it is looked at, without what the page itself chooses. */
function toShare({ fields, strategies }: Batch, { x, hidden, ...view }: BatchView): SharedView {
  const shown = {
    ...view,
    x: x ?? fields[0]?.name ?? null,
    hidden: hidden.filter((id) => strategies.some((each) => each === id)),
  };
  return Object.fromEntries(Object.entries(shown).filter(([, value]) => value !== null));
}

/** All sweeps there are. */
export function SweepsPage() {
  const lead = (
    <>
      Many variants of one scenario, each under the same strategies. <LabLink size="md">The lab</LabLink> starts one
      over the scenario it shows: “Sweep…”, at its top.
    </>
  );
  return (
    <Page title="Sweeps" lead={lead}>
      <SweepList />
    </Page>
  );
}
