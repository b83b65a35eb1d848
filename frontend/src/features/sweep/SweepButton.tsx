/** Opens the sweep dialog over the form's scenario; its code is fetched when somebody first does. */

import { Button, Tooltip } from "@mantine/core";
import { useDisclosure } from "@mantine/hooks";
import { IconGridDots } from "../../ui/icons";
import { lazy } from "react";
import { useAction, useActionButton } from "../../lab/actions";
import { useForm, useStrategies } from "../../server/useCatalogues";
import { compact } from "../../ui/compact";
import { LazyPart } from "../../ui/LazyPart";

const SweepDialog = lazy(() => import("./SweepDialog").then((module) => ({ default: module.SweepDialog })));

export function SweepButton() {
  const [opened, { open, close }] = useDisclosure(false);
  const [form, strategies] = [useForm(), useStrategies()];
  useAction("sweep", open);
  const { label, ...button } = useActionButton("sweep");
  return (
    <>
      <Tooltip label="Run many variants of this scenario">
        <Button aria-label={label} leftSection={<IconGridDots size={15} />} classNames={compact} {...button}>
          {label}
        </Button>
      </Tooltip>
      {opened && (
        <LazyPart onClose={close}>
          <SweepDialog form={form} strategies={strategies} onClose={close} />
        </LazyPart>
      )}
    </>
  );
}
