/** The comparison where there is little width: a row per signal, a column for each strategy of each variant. */

import type { SignalKey } from "../../api/types";
import { DataTable } from "../../ui/DataTable";
import ui from "../../ui/ui.module.css";
import { labelOf, UnitAndSolve, type ComparisonProps, type WindowView } from "./ComparisonTable";
import { entryGroups } from "./entries";
import { EntryHead } from "./EntryHead";
import { cellAttributes, ResultCell } from "./ResultCell";
import classes from "./tables.module.css";
import { shownUnit } from "../../server/units";
import { variantColumns } from "./variantColumns";

interface Props extends ComparisonProps {
  readonly view: WindowView;
  readonly heading: string;
}

export function NarrowTable({ scene, catalogue, figures, signals, view: { window, statistic }, heading }: Props) {
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
              {labelOf(signal, catalogue)}{" "}
              <span className={ui.dim}>
                <UnitAndSolve
                  unit={shownUnit(signal, figures, catalogue).unit}
                  metric={metricOf(signal)}
                  catalogue={catalogue}
                />
              </span>
            </>
          ),
        },
        ...variantColumns<SignalKey>(
          entryGroups(scene),
          (entry) => <EntryHead entry={entry} catalogue={catalogue} upright />,
          (entry) => ({
            attributes: (signal) => ({
              ...cellAttributes(entry, metricOf(signal)),
              "data-baseline": entry.isBaseline || undefined,
            }),
            cell: (signal) => (
              <ResultCell
                {...{ scene, entry }}
                metric={metricOf(signal)}
                scale={shownUnit(signal, figures, catalogue).scale}
              />
            ),
          }),
        ),
      ]}
    />
  );
}
