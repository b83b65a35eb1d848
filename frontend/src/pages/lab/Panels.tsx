/** Panels whose code is fetched when somebody first asks for them. */

import { useDisclosure } from "@mantine/hooks";
import { lazy, useEffect, useRef } from "react";
import { useAction, useActionButton } from "../../lab/actions";
import { useLabContext, useView } from "../../lab/context";
import { type ResultView, axisKey } from "../../lab/resultView";
import { LazyPart } from "../../ui/LazyPart";
import type { Axis, InstantPlace, Zoom } from "../../lab/address";
import { cursor } from "../../lab/cursor";
import { valueAt } from "../../lib/samples";
import { Button } from "@mantine/core";
import { Card } from "../../ui/Card";

const FuzzyPanel = lazy(() =>
  import("../../features/fuzzy/FuzzyPanel").then((module) => ({ default: module.FuzzyPanel })),
);

export function FuzzyPart({ resultView }: { readonly resultView: ResultView }) {
  const { labAddress } = useLabContext();
  const { instant } = useView();
  const [opened, { open, close }] = useDisclosure(false);
  useAction("fuzzy", () => {
    labAddress.setView({ instant: null }); // it has the same place
    open();
  });
  if (!opened || instant !== null) return null;
  return (
    <LazyPart onClose={close}>
      <FuzzyPanel resultView={resultView} onClose={close} />
    </LazyPart>
  );
}

const InstantPanel = lazy(() =>
  import("../../features/instant/InstantPanel").then((module) => ({ default: module.InstantPanel })),
);

/** From one axis to the other along a strategy's drive; `null` beside it. */
export function converted({ series }: ResultView, strategy: string, x: number, from: Axis, to: Axis): number | null {
  const [of, into] = [series[strategy]?.[axisKey(from)], series[strategy]?.[axisKey(to)]];
  return of && into ? valueAt(of, into, x) : null;
}

/** A range so wide, within the whole, with a place in its middle where there is room. */
function around(at: number, width: number, [first, last]: Zoom): Zoom {
  const low = Math.max(first, Math.min(at - width / 2, last - width));
  return [low, low + width];
}

export function InstantPart({ resultView }: { readonly resultView: ResultView }) {
  const { labAddress } = useLabContext();
  const { instant } = useView();
  const { axis, ids, bump, whole } = resultView;
  // Without a choice the first that is on; one that is off is no choice.
  const strategy = instant && ids.includes(instant.strategy) ? instant.strategy : ids[0];
  const placeAt = (x: number): InstantPlace | null => {
    const position = strategy === undefined ? null : converted(resultView, strategy, x, axis, "distance");
    return strategy === undefined || position === null ? null : { strategy, position };
  };
  const opened = instant !== null;
  useAction(
    "instant",
    strategy === undefined
      ? null
      : () => {
          const at = cursor.get(axis) ?? (bump ? (bump[0] + bump[1]) / 2 : (whole[0] + whole[1]) / 2);
          cursor.set(axis, at);
          labAddress.setView({ instant: placeAt(at) });
        },
  );
  // A link's instant is where the cursor stands, and the plots show it.
  useEffect(() => {
    if (instant === null || strategy === undefined || cursor.get(axis) !== null) return;
    const at = converted(resultView, strategy, instant.position, "distance", axis);
    cursor.set(axis, at);
    const [low, high] = resultView.range;
    if (at !== null && (at < low || at > high)) labAddress.setView({ zoom: around(at, high - low, resultView.whole) });
  }, [instant, strategy, axis, resultView, labAddress]);
  if (!opened || strategy === undefined) return null;
  return (
    <LazyPart onClose={() => labAddress.setView({ instant: null })}>
      <InstantPanel {...{ resultView, strategy, placeAt }} />
    </LazyPart>
  );
}

const FrequencyCard = lazy(() =>
  import("../../features/frequency/FrequencyCard").then((module) => ({ default: module.FrequencyCard })),
);

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
