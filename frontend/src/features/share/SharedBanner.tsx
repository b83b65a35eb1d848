/** Says that this is a shared result, when and by what it was computed, and the two ways on. */

import { Button, Group, Text } from "@mantine/core";
import { useMutation } from "@tanstack/react-query";
import type { ReactNode } from "react";
import { Icon } from "../../ui/icons";
import { api } from "../../api/client";
import type { Link, Run, Strategy } from "../../api/types";
import { useLabContext, useLab } from "../../lab/context";
import { useSelector } from "@tanstack/react-store";
import { DifferencesCard } from "./DifferencesCard";
import ui from "../../ui/ui.module.css";
import { Fault } from "../../ui/Messages";
import { formatDay } from "../../units/dates";

export function SharedBanner({ strategies }: { readonly strategies: readonly Strategy[] }) {
  const { labAddress } = useLabContext();
  const { slug } = useSelector(labAddress);
  const shared = useLab((state) => state.shared);
  const failed = useLab((state) => state.failure !== null && state.failure.kind !== "unreachable");
  if (shared?.run) return <Banner key={shared.slug} link={shared} run={shared.run} strategies={strategies} />;
  // Its place is kept while the link is being opened.
  return slug !== null && !failed ? (
    <div className={ui.banner} aria-busy aria-label="Opening the shared result" />
  ) : null;
}

interface BannerProps {
  readonly link: Link;
  readonly run: Run;
  readonly strategies: readonly Strategy[];
}

function Banner({ link, run, strategies }: BannerProps) {
  const { lab, labAddress } = useLabContext();
  // The link's pins stay with it: what is against one of them would be against something else in the copy.
  const openCopy = () => {
    if (link.view.reference) labAddress.setView({ reference: "baseline", differences: false });
    lab.openCopy();
  };
  const over = run.over && { roads: run.over.roads, baseline: run.over.baseline };
  const again = useMutation({
    mutationFn: () => api.createRun(link.scenario, Object.keys(run.strategies), undefined, over),
  });
  return (
    <>
      <SharedNote link={link} what="result">
        <Group gap="0.4rem" data-unprinted>
          <Button variant="filled" leftSection={<Icon name="Copy" size={15} />} onClick={openCopy}>
            Open a copy to edit
          </Button>
          <Button
            leftSection={<Icon name="Refresh" size={15} />}
            loading={again.isPending}
            onClick={() => again.mutate()}
          >
            Run again on this version
          </Button>
        </Group>
      </SharedNote>
      {again.isError && (
        <Fault size="md" m="0.5rem 0.2rem 0">
          It could not be run again: {again.error.message}
        </Fault>
      )}
      {again.data && <DifferencesCard strategies={strategies} then={run} now={again.data} onClose={again.reset} />}
    </>
  );
}

interface SharedNoteProps {
  readonly link: Link;
  readonly what: "result" | "sweep";
  readonly children?: ReactNode;
}

/** Says that this is shared, when it was computed and by what, and what can be done with it. */
export function SharedNote({ link, what, children }: SharedNoteProps) {
  return (
    <section className={ui.banner} aria-label="Shared result">
      <Icon name="Lock" size={17} stroke={1.7} />
      <Text flex="1 1 14rem">
        Shared {what}, computed on {formatDay(link.computed_at)} by core {link.core_version}. Read-only.
        {link.damaged_at !== null &&
          ` Something stored of it was found damaged on ${formatDay(link.damaged_at)} and computed again by that core: it may differ from what was shared.`}
        {link.core_version !== link.current_core_version && ` This server now runs core ${link.current_core_version}.`}
      </Text>
      {children}
    </section>
  );
}
