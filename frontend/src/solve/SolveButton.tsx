/** Opens the dialog that finds how large a field may be; its code is fetched when somebody first does. */

import { Button } from "@mantine/core";
import { useDisclosure } from "@mantine/hooks";
import { lazy, Suspense } from "react";
import { useCatalogues } from "../state/useCatalogues";
import tables from "../tables/tables.module.css";

const SolveDialog = lazy(() => import("./SolveDialog").then((module) => ({ default: module.SolveDialog })));

export function SolveButton() {
  const [opened, { open, close }] = useDisclosure(false);
  const { catalogues } = useCatalogues();
  return (
    <>
      <Button className={tables.moreButton ?? ""} size="compact-xs" variant="subtle" disabled={catalogues === null} onClick={open}>
        How large may it be?
      </Button>
      {opened && catalogues && (
        <Suspense>
          <SolveDialog catalogues={catalogues} onClose={close} />
        </Suspense>
      )}
    </>
  );
}
