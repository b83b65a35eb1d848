/** Finds a metric of a run by its name. */

import { optionsOf, type Figure } from "../../server/metrics";
import { Finder } from "../../ui/Finder";
import classes from "./tuner.module.css";

interface Props {
  readonly label: string;
  readonly figures: readonly Figure[];
  /** What stands before the figures. */
  readonly first?: readonly { readonly value: string; readonly label: string }[];
  readonly error?: string | undefined;
  readonly onPick: (key: string) => void;
}

export function FigureSelect({ figures, first = [], ...props }: Props) {
  const data = [
    ...(first.length > 0 ? [{ group: "Sums over the passive car’s", items: [...first] }] : []),
    ...optionsOf(figures),
  ];
  return (
    <Finder
      className={classes.select ?? ""}
      placeholder="Name of a metric…"
      nothingFoundMessage="No metric of that name"
      data={data}
      {...props}
    />
  );
}
