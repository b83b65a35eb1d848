/** What the last edit changed: a chip for each of the eight metrics, which leads to its plot. */

import { Group } from "@mantine/core";
import { useState } from "react";
import type { Catalogue, OverRoads, Strategy, StrategyId } from "../../api/types";
import { useLabContext, useReadOnly } from "../../lab/context";
import { whyNotCompared, type Variant } from "../../lab/compare";
import type { ResultView } from "../../lab/resultView";
import { labelled, Choice } from "../../ui/Entry";
import { ChangeText } from "../tables/ChangeMark";
import { VIEWS, changeBetween, comparedMetrics } from "../tables/entries";
import { metricName, type WindowMetric } from "../../lab/metricPath";
import { requiredOf } from "../requirements/judged";
import { EqualSpeed, usePairedChanges } from "./VerdictLine";
import ui from "../../ui/ui.module.css";
import type { Change } from "../tables/change";
import { RequirementMarks } from "../requirements/RequirementsCard";
import { useLabels, type Labels } from "../../server/useCatalogues";

const LOOK = { gap: "0.25rem 0.5rem", mih: 30, px: "0.2rem", fz: "xs", c: "dimmed" };

export function ChangeChips({ resultView }: { readonly resultView: ResultView }) {
  const words = useLabels();
  const { before, shown, strategies } = resultView;
  const [picked, setPicked] = useState<string | null>(null);
  const readOnly = useReadOnly();
  const unlike = before && whyNotCompared(shown, before.shown);
  const paired = usePairedChanges(
    shown,
    unlike === null && before?.shown.runId ? { against: before.shown.runId } : null,
  );
  const note =
    before === null
      ? "After an edit, what it changes in eight metrics stands here."
      : unlike !== null && `The state before is ${unlike}: its changes are not shown.`;
  if (before === null && readOnly) return null;
  if (before === null || note)
    return (
      <Group {...LOOK} data-unprinted>
        {note} <EqualSpeed resultView={resultView} />
      </Group>
    );
  const changes = editChanges(resultView, before, { ...words.catalogue, unit: words.unit }, paired);
  const strategy = strategies.find(({ id }) => id === picked) ?? changedMost(changes, strategies);
  const of = changes.filter((each) => each.strategy === strategy?.id);
  return (
    <Group {...LOOK} data-unprinted role="group" aria-label={`Changes against the state ${before.name}`}>
      <Choice
        size="xs"
        aria-label="Changes of"
        value={strategy?.id}
        data={labelled(strategies)}
        w="7.5rem"
        onPick={setPicked}
      />
      {VIEWS.map((view) => (
        <Group key={view.window} component="span" gap="0.2rem" title={words.view(view)}>
          {windowName(view.window)}
          {of
            .filter(({ metric }) => metric.window === view.window)
            .map(({ metric, change }) => (
              <ChangeChip
                key={metric.signal}
                metric={metric}
                label={words.signal(metric.signal)}
                change={change}
                required={strategy ? requiredOf(resultView.judged, { shown, strategy }, metricName(metric)) : []}
              />
            ))}
        </Group>
      ))}
      <EqualSpeed resultView={resultView} />
    </Group>
  );
}

const windowName = (window: string) => (window === "bump" ? "Bump" : "Rough road");

interface ChipProps {
  readonly metric: WindowMetric;
  readonly label: string;
  readonly change: Parameters<typeof ChangeText>[0]["change"];
  readonly required: Parameters<typeof RequirementMarks>[0]["results"];
}

function ChangeChip({ metric: { window, signal }, label, change, required }: ChipProps) {
  const { labAddress } = useLabContext();
  const show = () => {
    labAddress.setView({ zoom: window === "bump" ? null : "whole" });
    document.querySelector(`[data-figure="${signal}"]`)?.scrollIntoView({ block: "center" });
  };
  return (
    <button
      type="button"
      className={ui.pill}
      data-verdict={change?.verdict}
      title={`${label}: show its plot`}
      onClick={show}
    >
      <span aria-hidden>{shortName(label)}</span>
      <span className="visually-hidden">{label}</span> <ChangeText change={change} />
      <RequirementMarks results={required} />
    </button>
  );
}

interface EditChange {
  readonly strategy: StrategyId;
  readonly metric: WindowMetric;
  /** `null` until it is there. */
  readonly change: Change | null;
}

/** Each strategy's eight metrics against its own before. */
export function editChanges(
  { shown, strategies, summaries }: Pick<ResultView, "shown" | "strategies" | "summaries">,
  before: Variant,
  catalogue: Pick<Catalogue, "paper_signals"> & Pick<Labels, "unit">,
  paired: OverRoads["changes"] | undefined,
): readonly EditChange[] {
  return strategies.flatMap((strategy) =>
    comparedMetrics(catalogue).map((metric) => ({
      strategy: strategy.id,
      metric,
      change: changeBetween(
        { strategy, shown, summary: summaries[strategy.id] },
        { summary: before.shown.summaries[strategy.id], scenario: before.shown.scenario, pair: [strategy] },
        { metric, scale: catalogue.unit(metric.signal).scale, paired },
      ),
    })),
  );
}

/** The strategy that the edit moved in most metrics; the first where it moved none. */
export function changedMost(changes: readonly EditChange[], strategies: readonly Strategy[]): Strategy | undefined {
  const moved = ({ id }: Strategy) =>
    changes.filter(
      ({ strategy, change }) => strategy === id && change !== null && change.percent !== null && change.percent !== 0,
    ).length;
  return strategies.toSorted((one, other) => moved(other) - moved(one))[0];
}

/** `Front tyre` of `Front tyre dynamic load`: enough beside its plot's window. */
const shortName = (label: string): string => label.replace(/ (acceleration|dynamic load)$/, "");
