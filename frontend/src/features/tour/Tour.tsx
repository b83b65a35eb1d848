/** Five steps through the lab: each outlines a part of the page and says what it is for. */

import { Button, CloseButton, Group, Popover, Portal, Text } from "@mantine/core";
import { useWindowEvent } from "@mantine/hooks";
import { useEffect, useEffectEvent, useId, useLayoutEffect, useState, type Ref } from "react";
import classes from "./tour.module.css";
import { Note } from "../../ui/Messages";

interface Step {
  readonly title: string;
  readonly text: string;
  /** Of the outlined part; the first that is shown. */
  readonly targets: readonly string[];
}

const STEPS: readonly Step[] = [
  {
    title: "Change something",
    text: "Drag the height of the bump in the form: the curves move with it. Every value takes units, such as 12 cm; the question mark beside it opens the manual.",
    targets: ["aside [data-pointer='/road/bump/height']", "[data-tour=edit]"],
  },
  {
    title: "Choose who drives",
    text: "Each strategy is one way to control the same car on the same road. Passive has no control at all; more are in the menu.",
    targets: ["[role=group][aria-label=Strategies]"],
  },
  {
    title: "Look at one place",
    text: "Point at a plot: all plots and the car show the same place of the drive. Drag across a plot to zoom; a double click shows the whole run.",
    targets: ["section[data-figure=body_acceleration]"],
  },
  {
    title: "See who is better, and whether that is random",
    text: "The best value of each column is bold. A change has an arrow where it is beyond the random variation of one road; choose several roads above for means with intervals.",
    targets: ["section[aria-label=Comparison] [role=region]"],
  },
  {
    title: "Keep it, share it",
    text: "Share makes a link with these numbers. Sweep runs many variants, Library keeps yours, Export has plots and data. Ctrl + K finds everything by its name; Help has this tour again.",
    targets: ["button[aria-label=Share]"],
  },
];

const MARGIN = 6;

interface Place {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

const shownTarget = (targets: readonly string[]): Element | undefined =>
  targets.map((each) => document.querySelector(each)).find((each) => each?.checkVisibility()) ?? undefined;

/** Where it stands in the window; the window's middle for a part that is not there. */
function placeOf(target: Element | undefined): Place {
  if (!target) return { left: innerWidth / 2, top: innerHeight / 3, width: 0, height: 0 };
  const { left, top, width, height } = target.getBoundingClientRect();
  return { left: left - MARGIN, top: top - MARGIN, width: width + 2 * MARGIN, height: height + 2 * MARGIN };
}

/** The place of the step's target, which is brought into sight, however the page scrolls and grows. */
function usePlace({ targets }: Step): Place {
  const [place, setPlace] = useState<Place>(() => placeOf(shownTarget(targets)));
  const follow = () => setPlace(placeOf(shownTarget(targets)));
  useWindowEvent("scroll", follow, true);
  useWindowEvent("resize", follow);
  const grow = useEffectEvent(follow);
  useLayoutEffect(() => {
    shownTarget(targets)?.scrollIntoView({ block: "center" });
    const observer = new ResizeObserver(() => grow());
    observer.observe(document.body);
    return () => observer.disconnect();
  }, [targets]);
  return place;
}

export function Tour({ onEnd }: { readonly onEnd: () => void }) {
  const [index, setIndex] = useState(0);
  const [focused] = useState(() => document.activeElement);
  useEffect(
    () => () => {
      if (focused instanceof HTMLElement) focused.focus({ preventScroll: true });
    },
    [focused],
  );
  const step = STEPS[index];
  return step && <TourStep key={index} {...{ step, index, onEnd }} onStep={setIndex} />;
}

interface OutlineProps {
  readonly place: Place;
  readonly ref?: Ref<HTMLDivElement>;
}

const Outline = ({ place, ref }: OutlineProps) => (
  <Portal>
    <div className={classes.outline} data-unprinted style={place} ref={ref} />
  </Portal>
);

interface StepProps {
  readonly step: Step;
  readonly index: number;
  readonly onStep: (index: number) => void;
  readonly onEnd: () => void;
}

function TourStep({ step, index, onStep, onEnd }: StepProps) {
  const id = useId();
  const place = usePlace(step);
  const isLast = index === STEPS.length - 1;
  return (
    <Popover
      opened
      trapFocus
      withArrow
      withRoles={false}
      width={340}
      shadow="md"
      zIndex={300}
      closeOnClickOutside={false}
      transitionProps={{ duration: 0 }}
      preventPositionChangeWhenVisible={false}
      hideDetached={false}
      middlewares={{ flip: true, shift: { crossAxis: true, padding: MARGIN } }}
      onDismiss={onEnd}
    >
      <Popover.Target>
        <Outline place={place} />
      </Popover.Target>
      <Popover.Dropdown
        maw="calc(100vw - 1rem)"
        role="dialog"
        aria-labelledby={`${id}-title`}
        aria-describedby={`${id}-text`}
      >
        <Group justify="space-between" wrap="nowrap" gap="0.5rem">
          <Text fw={650} id={`${id}-title`}>
            {step.title}
          </Text>
          <CloseButton size="sm" aria-label="End the tour" onClick={onEnd} />
        </Group>
        <Text size="sm" my="0.5rem" id={`${id}-text`}>
          {step.text}
        </Text>
        <Group justify="space-between">
          <Note>
            {index + 1} of {STEPS.length}
          </Note>
          <Group gap="0.4rem">
            {index > 0 && <Button onClick={() => onStep(index - 1)}>Back</Button>}
            <Button variant="filled" data-autofocus onClick={isLast ? onEnd : () => onStep(index + 1)}>
              {isLast ? "Done" : "Next"}
            </Button>
          </Group>
        </Group>
      </Popover.Dropdown>
    </Popover>
  );
}
