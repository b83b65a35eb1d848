/** The comparison, and on demand everything else the run says in numbers. */

import { Button } from "@mantine/core";
import { IconChevronDown, IconChevronUp } from "../../ui/icons";
import { useMediaQuery } from "@mantine/hooks";
import { useId, useState } from "react";
import { CompareBar } from "../compare/CompareBar";
import type { Catalogue, FigureTemplate, SignalKey } from "../../api/types";
import type { Scene } from "../../lab/resultView";
import { ChangesNote } from "./ChangesNote";
import { ComparisonTable, headingOf, VIEWS } from "./ComparisonTable";
import { NarrowTable } from "./NarrowTable";
import { RunTable } from "./RunTable";
import classes from "./tables.module.css";
import { Card } from "../../ui/Card";

interface Props {
  readonly scene: Scene;
  readonly catalogue: Catalogue;
  readonly figures: Readonly<Record<string, FigureTemplate>>;
}

/** Windows too narrow, beside the form, for both halves of the comparison side by side. */
const NARROW = "(max-width: 67.99em)";

export function Tables({ scene, catalogue, figures }: Props) {
  const [more, setMore] = useState(false);
  const id = useId();
  const others = catalogue.metric_signals.filter((signal) => !catalogue.paper_signals.includes(signal));
  const narrow = useMediaQuery(NARROW, false, { getInitialValueInEffect: false });
  const compare = (signals: readonly SignalKey[], caption: string, of = "") =>
    narrow ? (
      VIEWS.map((view) => (
        <NarrowTable
          key={view.window}
          {...{ scene, catalogue, figures, signals, view }}
          heading={`${headingOf(view, catalogue)}${of}`}
        />
      ))
    ) : (
      <ComparisonTable {...{ scene, catalogue, figures, signals, caption }} />
    );
  return (
    <Card className={classes.comparison ?? ""} aria-label="Comparison">
      <CompareBar scene={scene} />
      {compare(catalogue.paper_signals, "RMS on the rough road and peak on the bump")}
      {more && (
        <div id={id}>
          {compare(others, "Suspension travel and actuator forces", ": travel and forces")}
          <RunTable scene={scene} catalogue={catalogue} />
        </div>
      )}
      <ChangesNote scene={scene} />
      <Button
        className={classes.moreButton ?? ""}
        size="compact-xs"
        variant="subtle"
        aria-expanded={more}
        {...(more ? { "aria-controls": id } : {})}
        rightSection={more ? <IconChevronUp size={14} /> : <IconChevronDown size={14} />}
        onClick={() => setMore(!more)}
      >
        {more ? "Less" : "Travel, forces, comfort, time and events"}
      </Button>
    </Card>
  );
}
