/** The comparison where there is little width: a row per signal, a column for each strategy of each variant. */

import { prettyUnit } from "../units/format";
import type { ComparisonProps, WindowView } from "./ComparisonTable";
import { entryGroups } from "./entries";
import { EntryHead } from "./EntryHead";
import { ResultCell } from "./ResultCell";
import classes from "./tables.module.css";
import { shownUnit } from "./units";
import { VariantHeads } from "./VariantHeads";
import { SolveButton } from "../solve/SolveButton";
import { ScrollTable } from "../ui/ScrollTable";

interface Props extends ComparisonProps {
  readonly view: WindowView;
  readonly heading: string;
}

export function NarrowTable({ scene, catalogue, figures, signals, view: { window, statistic }, heading }: Props) {
  const groups = entryGroups(scene);
  const entries = groups.flatMap((group) => group.entries);
  return (
    <ScrollTable label={heading} className={classes.table}>
      <caption className={classes.narrowCaption}>{heading}</caption>
      <thead>
        <VariantHeads groups={groups} />
        <tr>
          <td />
          {entries.map((entry) => (
            <th key={entry.key} scope="col" className={classes.narrowColumn}>
              <EntryHead entry={entry} catalogue={catalogue} upright />
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {signals.map((signal) => {
          const { unit, scale } = shownUnit(signal, figures, catalogue);
          return (
            <tr key={signal}>
              <th scope="row" className={classes.quantity}>
                {catalogue.signals.find(({ key }) => key === signal)?.label ?? signal} <span className={classes.columnUnit}>{prettyUnit(unit)}</span>{" "}
                <SolveButton metric={`${window}.${signal}.${statistic}`} label={`${catalogue.signals.find(({ key }) => key === signal)?.label ?? signal}, ${window.replace("_", " ")}`} />
              </th>
              {entries.map((entry) => (
                <ResultCell key={entry.key} name={`${window}.${signal}.${statistic}`} metric={{ window, signal, statistic }} marked {...{ scene, entry, scale }} />
              ))}
            </tr>
          );
        })}
      </tbody>
    </ScrollTable>
  );
}
