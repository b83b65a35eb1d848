/** What the last edit changed: a chip for each of the eight metrics, which leads to its plot. */

import { Group, NativeSelect } from "@mantine/core";
import { useState } from "react";
import type { Catalogue } from "../../api/types";
import { useLabContext } from "../../lab/context";
import { whyNotCompared } from "../../lab/compare";
import type { ResultView } from "../../lab/resultView";
import { labelled } from "../../ui/Entry";
import { ChangeText } from "../tables/ChangeMark";
import { headingOf, labelOf } from "../tables/ComparisonTable";
import { VIEWS } from "../tables/entries";
import { metricName, type WindowMetric } from "../../lab/metricPath";
import { requiredOf } from "../requirements/judged";
import { RequirementMarks } from "../requirements/RequirementMarks";
import { changedMost, editChanges, shortName } from "./edit";
import { EqualSpeed, usePairedChanges } from "./VerdictLine";
import classes from "./verdict.module.css";
import ui from "../../ui/ui.module.css";

interface Props {
  readonly resultView: ResultView;
  readonly catalogue: Catalogue;
}

export function ChangeChips({ resultView, catalogue }: Props) {
  const { before, shown, strategies } = resultView;
  const [picked, setPicked] = useState<string | null>(null);
  const unlike = before && whyNotCompared(shown, before.shown);
  const paired = usePairedChanges(
    shown,
    unlike === null && before?.shown.runId ? { against: before.shown.runId } : null,
  );
  const note =
    before === null
      ? "After an edit, what it changes in eight metrics stands here."
      : unlike !== null && `The state before is ${unlike}: its changes are not shown.`;
  if (before === null || note)
    return (
      <div className={classes.chips} data-unprinted>
        {note} <EqualSpeed resultView={resultView} />
      </div>
    );
  const changes = editChanges(resultView, before, catalogue, paired);
  const strategy = strategies.find(({ id }) => id === picked) ?? changedMost(changes, strategies);
  const of = changes.filter((each) => each.strategy === strategy?.id);
  return (
    <div className={classes.chips} data-unprinted role="group" aria-label={`Changes against the state ${before.name}`}>
      <NativeSelect
        size="xs"
        aria-label="Changes of"
        value={strategy?.id}
        data={labelled(strategies)}
        w="7.5rem"
        onChange={({ currentTarget: { value } }) => setPicked(value)}
      />
      {VIEWS.map((view) => (
        <Group key={view.window} component="span" gap="0.2rem" title={headingOf(view, catalogue)}>
          {windowName(view.window)}
          {of
            .filter(({ metric }) => metric.window === view.window)
            .map(({ metric, change }) => (
              <ChangeChip
                key={metric.signal}
                metric={metric}
                label={labelOf(metric.signal, catalogue)}
                change={change}
                required={strategy ? requiredOf(resultView.judged, { shown, strategy }, metricName(metric)) : []}
              />
            ))}
        </Group>
      ))}
      <EqualSpeed resultView={resultView} />
    </div>
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
