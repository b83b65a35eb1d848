/** Opens the dialog that finds how large a field may be; its code is fetched when somebody first does. */

import { ActionIcon } from "@mantine/core";
import { useDisclosure } from "@mantine/hooks";
import { lazy, memo } from "react";
import { Icon } from "../../ui/icons";
import { useCatalogues } from "../../server/useCatalogues";
import { LazyPart } from "../../ui/LazyPart";

const SolveDialog = lazy(() => import("./SolveDialog").then((module) => ({ default: module.SolveDialog })));

interface Props {
  /** The metric that has to keep a limit. */
  readonly metric: string;
  readonly label: string;
}

/** As it is while a slider moves. */
export const SolveButton = memo(function SolveButton({ metric, label }: Props) {
  const [opened, { open, close }] = useDisclosure(false);
  const catalogues = useCatalogues();
  return (
    <>
      <ActionIcon
        data-hint="How fast may it go so that this stays below a limit?"
        data-unprinted
        style={{ verticalAlign: "-0.3rem" }}
        size={24}
        variant="subtle"
        aria-label={`How fast may it go: ${label}`}
        onClick={open}
      >
        <Icon name="Gauge" size={14} stroke={1.7} />
      </ActionIcon>
      {opened && (
        <LazyPart onClose={close}>
          <SolveDialog {...{ catalogues, metric }} onClose={close} />
        </LazyPart>
      )}
    </>
  );
});
