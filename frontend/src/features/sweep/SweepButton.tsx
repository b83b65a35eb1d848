/** Opens the sweep dialog over the form's scenario or another sweep's; its code is fetched when somebody first does. */

import { Button } from "@mantine/core";
import { useDisclosure } from "@mantine/hooks";
import type { Batch } from "../../api/types";
import { Icon } from "../../ui/icons";
import { lazy } from "react";
import { useAction, useActionButton } from "../../lab/actions";
import { compact } from "../../ui/IconButton";
import { LazyPart } from "../../ui/LazyPart";

const SweepDialog = lazy(() => import("./SweepDialog").then((module) => ({ default: module.SweepDialog })));

export function SweepButton({ batch }: { readonly batch?: Batch }) {
  const [opened, { open, close }] = useDisclosure(false);
  useAction("sweep", open);
  const { label: title, ...button } = useActionButton("sweep");
  const [label, icon] = batch ? (["New sweep", "Plus"] as const) : ([title, "GridDots"] as const);
  return (
    <>
      <Button
        data-hint={`Run many variants of ${batch ? "its" : "this"} scenario`}
        aria-label={label}
        leftSection={<Icon name={icon} size={15} />}
        classNames={compact}
        {...button}
      >
        {label}
      </Button>
      {opened && (
        <LazyPart onClose={close}>
          <SweepDialog batch={batch} onClose={close} />
        </LazyPart>
      )}
    </>
  );
}
