/** What the lab shows of a run: the only part of the page that is rendered anew with each answer. */

import { Anchor, Button, Group, Text } from "@mantine/core";
import { useDeferredValue, useMemo } from "react";
import { useQuery } from "@tanstack/react-query";
import { Link } from "@tanstack/react-router";
import type { Strategy } from "../../api/types";
import { useCompared, usePaired } from "../../features/compare/useCompared";
import { endOffer, tourOffered } from "../../features/tour/offered";
import { useActionButton } from "../../lab/actions";
import { useLab, useView, useLabContext } from "../../lab/context";
import { baselineOf, partShown, withBaseline } from "../../lab/resultView";
import { Results } from "./Results";
import classes from "../../ui/shell.module.css";
import { LazyPart } from "../../ui/LazyPart";
import bar from "../../ui/toolbar.module.css";
import { SharedBanner, Toolbar } from "./afterCurves";
import { StatusLine } from "./StatusLine";
import { titleOf } from "../../features/sweep/table";
import { BATCH, jobQuery } from "../../jobs/useJob";
import { parseSearch } from "../../lab/address";
import { useSelector } from "@tanstack/react-store";
import { useJudged } from "../../features/requirements/judged";

/** Under a moving slider curves are drawn between the parts of what follows from this. */
function useDeferredWhile<Value>(isLive: boolean, newest: Value): Value {
  const deferred = useDeferredValue(newest);
  return isLive ? deferred : newest;
}

export function LabMain({ strategies }: { readonly strategies: readonly Strategy[] }) {
  const isLive = useLab((state) => state.shown?.source === "live");
  const shown = useDeferredWhile(
    isLive,
    useLab((state) => state.shown),
  );
  const selected = useLab((state) => state.strategies);
  const { axis, zoom, baseline: chosen, reference, differences, requirements } = useView();
  const compared = useDeferredWhile(isLive, useCompared());
  // Apart: another baseline leaves what is drawn as it is.
  const part = useMemo(
    () => (shown ? partShown(shown, strategies, selected, { axis, zoom }) : null),
    [shown, strategies, selected, axis, zoom],
  );
  const baseline = shown && baselineOf(shown, chosen);
  const paired = usePaired(part, compared, { baseline, reference });
  const judged = useJudged(part, compared, requirements, baseline ?? chosen);
  const resultView = useMemo(
    () =>
      part &&
      withBaseline(part, { baseline: chosen, reference, differences }, compared, { roadPairedChanges: paired, judged }),
    [part, chosen, reference, differences, compared, paired, judged],
  );
  const head = useMemo(
    () => (
      <>
        <Group gap="0 1rem" align="baseline" justify="space-between" mt="0.45rem">
          <Text component="h1" size="sm" fw={600} lh={1.3} c="dimmed">
            What-if laboratory for active suspension.{" "}
            <Text span inherit fw={400}>
              LV: longitudinal (speed) and vertical control.
            </Text>
          </Text>
          <FromPage />
        </Group>
        <LazyPart>
          <SharedBanner strategies={strategies} />
        </LazyPart>
      </>
    ),
    [strategies],
  );
  return (
    <main className={classes.main}>
      {head}
      <LazyPart fallback={<div className={`${bar.toolbar} ${bar.place}`} />}>
        <Toolbar
          strategies={strategies}
          part={
            resultView &&
            (resultView.range === resultView.bump ? "bump" : resultView.range === resultView.whole ? "whole" : "range")
          }
          hasBump={resultView !== null && resultView.bump !== null}
        />
      </LazyPart>
      <StatusLine position="page" />
      <Results {...{ strategies, resultView }} />
    </main>
  );
}

/** Where the lab's scenario comes from, if not from here, and the way there: another page, or the last visit. */
function FromPage() {
  const { lab, labAddress, restored } = useLabContext();
  const { from, slug } = useSelector(labAddress);
  // An edit makes the scenario this visit's.
  const untouched = useLab((state) => state.history?.present === restored);
  if (slug !== null) return null;
  if (from !== undefined) return <Back from={from} />;
  if (!untouched) return <TourOffer />;
  return (
    <Text size="xs" role="status">
      Your last scenario.{" "}
      <Anchor component="button" size="xs" underline="always" onClick={lab.openPaper}>
        Open the paper’s scenario
      </Anchor>
    </Text>
  );
}

/** To whoever is here for the first time. */
function TourOffer() {
  const offered = useSelector(tourOffered);
  const { label, disabled, onClick } = useActionButton("tour");
  if (!offered) return null;
  return (
    <Group gap="0.4rem" data-unprinted>
      <Text size="xs">New here?</Text>
      <Button size="compact-xs" variant="light" disabled={disabled} onClick={onClick}>
        {label}
      </Button>
      <Button size="compact-xs" variant="subtle" onClick={endOffer}>
        Not again
      </Button>
    </Group>
  );
}

const NAMES: Readonly<Record<string, string>> = {
  b: "sweep",
  robustness: "study",
  tuner: "tuning",
  paper: "the paper",
};

function Back({ from }: { readonly from: string }) {
  const [path = "", search = ""] = from.split("?");
  const [, page = "", id = ""] = path.split("/");
  const sweep = useQuery({ ...jobQuery(BATCH, id), enabled: page === "b" }).data;
  const name = [NAMES[page], ...(sweep ? [`“${sweep.label ?? titleOf(sweep.fields)}”`] : [])].join(" ");
  return (
    <Text size="xs">
      <Anchor
        size="xs"
        underline="always"
        renderRoot={(props) => <Link to={path} search={parseSearch(search)} {...props} />}
      >
        From {name}
      </Anchor>
    </Text>
  );
}
