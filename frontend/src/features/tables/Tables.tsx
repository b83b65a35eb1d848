/** The comparison, and on demand everything else the run says in numbers. */

import { Button, Box, Checkbox } from "@mantine/core";
import { useMediaQuery } from "@mantine/hooks";
import { useId, useState } from "react";
import { Icon } from "../../ui/icons";
import { CompareBar } from "../compare/CompareBar";
import { Solve } from "../solve/SolveButton";
import type { SignalKey } from "../../api/types";
import type { ResultView } from "../../lab/resultView";
import {
  ComparisonTable,
  UnitAndTools,
  type ComparisonProps,
  cellAttributes,
  ResultCell,
  EntryHead,
} from "./ComparisonTable";
import { RunTable, variantColumns } from "./RunTable";
import classes from "./tables.module.css";
import { Card } from "../../ui/Card";
import { getAt } from "../../scenario/path";
import { whyNotCompared } from "../../lab/compare";
import { DataTable } from "../../ui/DataTable";
import ui from "../../ui/ui.module.css";
import { entryGroups, isRandom, lowestOf, VIEWS, type WindowView } from "./entries";
import { useLabels } from "../../server/useCatalogues";

/** Windows too narrow, beside the form, for both halves of the comparison side by side; paper has no form. */
const NARROW = "screen and (max-width: 67.99em)";

export function Tables({ resultView }: { readonly resultView: ResultView }) {
  const words = useLabels();
  const { catalogue } = words;
  const [more, setMore] = useState(false);
  const id = useId();
  const others = catalogue.metric_signals.filter((signal) => !catalogue.paper_signals.includes(signal));
  const narrow = useMediaQuery(NARROW, false, { getInitialValueInEffect: false });
  const [grouping, setGrouping] = useState<ComparisonProps["grouping"]>("variant");
  const hasIntervals = [resultView, ...resultView.pins].some(({ shown }) => shown.over !== null);
  const compare = (signals: readonly SignalKey[], caption: string, of = "") =>
    narrow ? (
      VIEWS.map((view) => (
        <NarrowTable
          key={view.window}
          {...{ resultView, words, signals, view, grouping }}
          heading={`${words.view(view)}${of}`}
        />
      ))
    ) : (
      <ComparisonTable {...{ resultView, words, signals, caption, grouping }} />
    );
  return (
    <Card className={classes.comparison ?? ""} aria-label="Comparison" data-intervals={hasIntervals || undefined}>
      <CompareBar resultView={resultView} />
      <Solve />
      {!narrow && resultView.pins.length > 0 && (
        <Checkbox
          size="xs"
          m="0.4rem 0.9rem"
          wrapperProps={{ "data-unprinted": true }}
          label="Group by strategy"
          checked={grouping === "strategy"}
          onChange={({ currentTarget: { checked } }) => setGrouping(checked ? "strategy" : "variant")}
        />
      )}
      {compare(catalogue.paper_signals, "RMS on the rough road and peak on the bump")}
      {more && (
        <div id={id}>
          {compare(others, "Suspension travel and actuator forces", ": travel and forces")}
          <RunTable resultView={resultView} />
        </div>
      )}
      <ChangesNote resultView={resultView} />
      <Button
        data-unprinted
        m="0.15rem 0.4rem 0.3rem"
        size="compact-xs"
        variant="subtle"
        aria-expanded={more}
        {...(more ? { "aria-controls": id } : {})}
        rightSection={more ? <Icon name="ChevronUp" size={14} /> : <Icon name="ChevronDown" size={14} />}
        onClick={() => setMore(!more)}
      >
        {more ? "Less" : "Travel, forces, comfort, time and events"}
      </Button>
    </Card>
  );
}

function textOf({ shown, reference }: ResultView): string {
  const { over, scenario } = shown;
  const isMeasured = typeof getAt(scenario, "/road/profile") === "string"; // then there is no other road like it
  if (over === null && !isRandom(scenario)) return "A change without an arrow is zero.";
  if (over === null)
    return `One road: a change without an arrow is zero or within one road’s luck${isMeasured ? "" : "; choose several roads"}.`;
  const isPaired = reference === null || whyNotCompared(shown, reference.shown) === null;
  return isPaired
    ? "Changes are paired by road, with their 95 % interval; one whose interval includes zero has no arrow."
    : "\u00a0";
}

/** What a change without an arrow says. */
function ChangesNote({ resultView }: { readonly resultView: ResultView }) {
  return (
    <Box component="p" m={0} p="0.3rem 0.9rem 0" fz="xs" c="dimmed" data-testid="changes-note">
      {textOf(resultView)}
    </Box>
  );
}

interface NarrowTableProps extends ComparisonProps {
  readonly view: WindowView;
  readonly heading: string;
}

/** The comparison where there is little width: a row per signal, a column for each strategy of each variant. */
function NarrowTable({ resultView, words, signals, view: { window, statistic }, heading }: NarrowTableProps) {
  const groups = entryGroups(resultView);
  const metricOf = (signal: SignalKey) => ({ window, signal, statistic });
  return (
    <DataTable
      label={heading}
      captioned
      attributes={{ className: classes.comparison }}
      rows={signals}
      rowKey={(signal) => signal}
      columns={[
        {
          key: "signal",
          head: "",
          text: true,
          cell: (signal) => (
            <>
              {words.signal(signal)}{" "}
              <span className={ui.dim}>
                <UnitAndTools metric={metricOf(signal)} words={words} />
              </span>
            </>
          ),
        },
        ...variantColumns<SignalKey>(
          groups,
          (entry) => <EntryHead entry={entry} catalogue={words.catalogue} upright />,
          (entry) => ({
            attributes: (signal) => ({
              ...cellAttributes(entry, metricOf(signal)),
              "data-baseline": entry.isBaseline || undefined,
            }),
            cell: (signal) => (
              <ResultCell
                {...{ resultView, entry }}
                metric={metricOf(signal)}
                lowest={lowestOf(groups, metricOf(signal))}
                scale={words.unit(signal).scale}
              />
            ),
          }),
        ),
      ]}
    />
  );
}
