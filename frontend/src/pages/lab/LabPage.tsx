import { Box, Skeleton, Stack, Button, Loader, Text, Anchor, Group } from "@mantine/core";
import { lazy, useEffect, useState, useMemo, useRef, useDeferredValue } from "react";
import { useDocumentTitle } from "@mantine/hooks";
import { DropFiles, EditorPane, LabActions, LabTools, SharedBanner, Toolbar } from "./afterCurves";
import { PageLoading, ShellSlot } from "../../ui/Page";
import { StatusLine } from "./StatusLine";
import classes from "../../ui/shell.module.css";
import { useLab, useLabContext, useView } from "../../lab/context";
import { useLabStrategies } from "../../lab/recordings";
import { useSchemeColours, useStrategies } from "../../server/useCatalogues";
import { LazyPart } from "../../ui/LazyPart";
import { type Scenario, type Strategy, type Summary } from "../../api/types";
import { hasErrors } from "../../lab/problems";
import { getAt, numberAt } from "../../scenario/path";
import { type Result } from "../../lab/result";
import ui from "../../ui/ui.module.css";
import { isRecording } from "../../lib/recording";
import { lawsOf } from "../../server/queries";
import { useQuery } from "@tanstack/react-query";
import { Link } from "@tanstack/react-router";
import { useCompared, usePaired } from "../../features/compare/useCompared";
import { endOffer, tourOffered } from "../../features/tour/offered";
import { useActionButton } from "../../lab/actions";
import { baselineOf, partShown, withBaseline } from "../../lab/resultView";
import { Results } from "./Results";
import bar from "../../ui/toolbar.module.css";
import { titleOf } from "../../features/sweep/table";
import { BATCH, jobQuery } from "../../jobs/useJob";
import { parseSearch } from "../../lab/address";
import { useSelector } from "@tanstack/react-store";
import { useJudged } from "../../features/requirements/judged";

const SharedSweep = lazy(() => import("../sweep/SweepPage").then((module) => ({ default: module.SharedSweep })));

/** The lab, or the sweep that a link shows in its place. */
export function LabPage() {
  const shared = useLab((state) => state.shared);
  return shared?.batch ? (
    <LazyPart fallback={<PageLoading />}>
      <SharedSweep key={shared.slug} link={shared} batch={shared.batch} />
    </LazyPart>
  ) : (
    <LabContent />
  );
}

function LabContent() {
  useSavedLaws();
  const strategies = useWithGone(useLabStrategies());
  const coloured = useSchemeColours(strategies);
  return (
    <>
      <ShellSlot name="tools">
        <LazyPart>
          <LabTools />
          <LabActions />
          <DropFiles />
        </LazyPart>
      </ShellSlot>
      <PrintedTitle />
      <div className={classes.body}>
        <LazyPart fallback={<EditorLoading />}>
          <EditorPane />
        </LazyPart>
        <LabMain strategies={coloured} />
      </div>
      <ShellSlot name="notices">
        <Notices />
      </ShellSlot>
    </>
  );
}

function EditorLoading() {
  return (
    <Box component="aside" visibleFrom="sm" className={classes.aside} data-unprinted aria-label="Scenario" aria-busy>
      <Stack gap="0.9rem" p="1.2rem 1rem">
        {Array.from({ length: 9 }, (_, index) => (
          <Skeleton key={index} height={index % 4 === 0 ? 18 : 44} width={index % 4 === 0 ? "45%" : "100%"} />
        ))}
      </Stack>
    </Box>
  );
}

/** The tab's title; on paper also where this comes from. */
function PrintedTitle() {
  const source = useLab(
    ({ shown }) =>
      shown && `core ${shown.coreVersion}${shown.runId === null ? ", a live preview" : `, run ${shown.runId}`}`,
  );
  // Not of each step of a slider: the browser itself shows it.
  const { paperScenario } = useLabContext();
  const title = useLab(({ history }) => pageTitle(history?.present ?? paperScenario));
  useDocumentTitle(title);
  if (source === null) return null;
  return (
    <p className={classes.printed}>
      {title} {source}
    </p>
  );
}

/** The browser tab's title: what this scenario is about, in a few words. */
function pageTitle(scenario: Scenario): string {
  const height = numberAt(scenario, "/road/bump/height", NaN);
  const from = numberAt(scenario, "/speed/initial_speed_kmh", NaN);
  const to = numberAt(scenario, "/speed/target_speed_kmh", NaN);
  if ([height, from, to].some(Number.isNaN)) return "Ridelab";
  const count = numberAt(scenario, "/road/bump/count", 1);
  const several = count > 1 ? `${count} × ` : "";
  const kind = getAt(scenario, "/road/bump/shape") === "kerb" ? "kerb" : height > 0 ? "bump" : "pothole";
  const plain = typeof getAt(scenario, "/road/profile") === "string" ? "measured road" : "no bump";
  const obstacle = height === 0 ? plain : `${several}${Math.abs(height * 1000).toFixed(0)} mm ${kind}`;
  return `${obstacle}, ${from} → ${to} km/h · Ridelab`;
}

const SLOW_AFTER_MS = 1200;

function Notices() {
  const strategies = useStrategies();
  const busy = useLab((state) => state.busy);
  const failure = useLab((state) => state.failure);
  const refused = useLab((state) => hasErrors(state.serverErrors));
  const shown = useLab((state) => state.shown);
  // There is no table to say why.
  const none = useLab(({ strategies: on }) => shown !== null && !on.some((id) => id in shown.summaries));
  const { lab } = useLabContext();
  const isShared = useLab((state) => state.shared !== null);
  const laws = lawsText(strategies, busy || !shown ? {} : shown.summaries);
  return (
    <>
      {busy && <SlowNotice shown={shown} />}
      {refused && shown && (
        <div className={ui.notice} role="status">
          <Text>The plots show the last scenario that could be run; the value to change is marked in the form.</Text>
          <Button size="compact-xs" onClick={lab.undo}>
            Undo
          </Button>
        </div>
      )}
      {failure?.kind === "failed" && (
        <div className={ui.notice} role="alert">
          <Text>This scenario could not be run: {failure.message}</Text>
        </div>
      )}
      {laws.changed.length > 0 && (
        <div className={ui.notice} role="status">
          <Text>
            {laws.changed.join(", ")}: the file was saved since. These are the numbers of the law that stood there.
          </Text>
          {!isShared && (
            <Button size="compact-xs" onClick={lab.runAgain}>
              Run again
            </Button>
          )}
        </div>
      )}
      {laws.gone.length > 0 && (
        <div className={ui.notice} role="status">
          <Text>{laws.gone.join(", ")}: there is no such controller here any more. These are the stored numbers.</Text>
        </div>
      )}
      {none &&
        shown?.failed.map(({ strategy, message }) => (
          <div key={strategy} className={ui.notice} role="alert">
            <Text>
              {strategies.find(({ id }) => id === strategy)?.label ?? strategy} could not be computed: {message}
            </Text>
          </div>
        ))}
    </>
  );
}

/** Mounted with a request; speaks up only where nothing new is shown for long. */
function SlowNotice({ shown }: { readonly shown: Result | null }) {
  const [slow, setSlow] = useState<Result | null>();
  useEffect(() => {
    const timer = setTimeout(() => setSlow(shown), SLOW_AFTER_MS);
    return () => clearTimeout(timer);
  }, [shown]);
  if (slow !== shown) return null;
  return (
    <div className={ui.notice} role="status">
      <Loader size={14} />
      <Text>Computing. The previous curves are dimmed until the new ones arrive.</Text>
    </div>
  );
}

/** Runs what is shown again where the file of one that is chosen was saved. */
function useSavedLaws(): void {
  const strategies = useStrategies();
  const { lab } = useLabContext();
  const laws = lawsOf(strategies);
  const lastLaws = useRef(laws);
  useEffect(() => {
    if (lastLaws.current === laws) return;
    lastLaws.current = laws;
    const { shown, strategies: switchedOn } = lab.get();
    const isOld = ({ id, own, source }: Strategy) =>
      own && switchedOn.includes(id) && shown?.summaries[id]?.source?.digest !== source?.digest;
    if (shown && strategies.some(isOld)) lab.runAgain();
  }, [laws, strategies, lab]);
}

/** The strategies, and those of the shown result that are there no more: their numbers stay. */
function useWithGone(strategies: readonly Strategy[]): readonly Strategy[] {
  const gone = useLab(({ shown }) =>
    Object.keys(shown?.summaries ?? {})
      .filter((id) => !isRecording(id) && strategies.every((strategy) => strategy.id !== id))
      .join(),
  );
  return useMemo(
    () => (gone === "" ? strategies : [...strategies, ...gone.split(",").map(goneLaw)]),
    [gone, strategies],
  );
}

const GREY = "#868E96";

const goneLaw = (id: string): Strategy => ({
  id,
  label: id,
  description: "Its file is there no more: these are the numbers that were stored.",
  reads: [],
  reads_when: [],
  colour: GREY,
  dark_colour: GREY,
  dash: "solid",
  own: true,
  source: null,
  options: {},
  fault: null,
  one_road_resolution: {},
});

/** What is to be said of results whose law is another one by now, or gone. */
function lawsText(strategies: readonly Strategy[], summaries: Readonly<Record<string, Summary>>) {
  const of = (isSo: (strategy: Strategy | undefined) => boolean) =>
    Object.entries(summaries).flatMap(([id, { source }]) => {
      const strategy = strategies.find((each) => each.id === id);
      return source && isSo(strategy) && strategy?.source?.digest !== source.digest ? [`${id} (${source.file})`] : [];
    });
  return { changed: of((strategy) => Boolean(strategy)), gone: of((strategy) => !strategy) };
}

/** Under a moving slider curves are drawn between the parts of what follows from this. */
function useDeferredWhile<Value>(isLive: boolean, newest: Value): Value {
  const deferred = useDeferredValue(newest);
  return isLive ? deferred : newest;
}

function LabMain({ strategies }: { readonly strategies: readonly Strategy[] }) {
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
