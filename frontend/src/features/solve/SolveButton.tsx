/** Opens the dialog that finds how large a field may be; its code is fetched when somebody first does. */

import { ActionIcon } from "@mantine/core";
import { createAtom, useSelector } from "@tanstack/react-store";
import { lazy, memo, useEffect } from "react";
import { useAction } from "../../lab/actions";
import { Icon } from "../../ui/icons";
import { useCatalogue } from "../../server/useCatalogues";
import { LazyPart } from "../../ui/LazyPart";

const SolveDialog = lazy(() => import("./SolveDialog").then((module) => ({ default: module.SolveDialog })));

/** The metric that the dialog is opened on. */
const asked = createAtom<string | null>(null);

interface Props {
  /** The metric that has to keep a limit. */
  readonly metric: string;
  readonly label: string;
}

/** As it is while a slider moves. */
export const SolveButton = memo(function SolveButton({ metric, label }: Props) {
  return (
    <ActionIcon
      data-hint="How fast may it go so that this stays below a limit?"
      data-unprinted
      style={{ verticalAlign: "-0.3rem" }}
      size={24}
      variant="subtle"
      aria-label={`How fast may it go: ${label}`}
      onClick={() => asked.set(metric)}
    >
      <Icon name="Gauge" size={14} stroke={1.7} />
    </ActionIcon>
  );
});

/** The dialog itself, while one is asked for; by the action about the first metric on the bump. */
export function Solve() {
  const { paper_signals } = useCatalogue();
  const metric = useSelector(asked);
  useAction("solve", () => asked.set(`bump.${paper_signals[0] ?? ""}.peak`));
  useEffect(() => () => asked.set(null), []);
  const close = () => asked.set(null);
  return (
    metric !== null && (
      <LazyPart onClose={close}>
        <SolveDialog metric={metric} onClose={close} />
      </LazyPart>
    )
  );
}
