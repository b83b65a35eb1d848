/** The lab's part on frequencies: closed until somebody asks, then its code is fetched. */

import { Button } from "@mantine/core";
import { useDisclosure } from "@mantine/hooks";
import { lazy, useRef } from "react";
import { useAction, useActionButton } from "../../lab/actions";
import type { ResultView } from "../../lab/resultView";
import { Card } from "../../ui/Card";
import { LazyPart } from "../../ui/LazyPart";

const FrequencyCard = lazy(() => import("./FrequencyCard").then((module) => ({ default: module.FrequencyCard })));

export function FrequencyPart(props: { readonly resultView: ResultView }) {
  const [opened, { toggle }] = useDisclosure(false);
  const part = useRef<HTMLDivElement>(null);
  useAction("frequencies", () => {
    toggle();
    if (!opened) part.current?.scrollIntoView({ block: "center" });
  });
  const { onClick, disabled } = useActionButton("frequencies");
  return (
    <div ref={part} data-unprinted={!opened || undefined}>
      <Card
        aria-label="Frequencies"
        title="Frequencies: responses, modes and margins"
        tools={
          <Button size="compact-sm" variant="default" aria-expanded={opened} {...{ onClick, disabled }}>
            {opened ? "Hide" : "Show"}
          </Button>
        }
      >
        {opened && (
          <LazyPart>
            <FrequencyCard {...props} />
          </LazyPart>
        )}
      </Card>
    </div>
  );
}
