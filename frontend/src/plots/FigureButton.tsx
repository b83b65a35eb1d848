/** Enlarges or saves one figure; what either takes is loaded when it is wanted. */

import { ActionIcon } from "@mantine/core";
import { useDisclosure } from "@mantine/hooks";
import { lazy, useMemo, useState, type ComponentProps } from "react";
import type { FigureTemplate } from "../api/types";
import { Icon } from "../ui/icons";
import { LazyPart } from "../ui/LazyPart";
import type { CurvesSource } from "./curves";
import { requestPlotly } from "./plotly";
import type { FigureSource } from "./saved";

const EnlargedFigure = lazy(() => import("./EnlargedFigure").then((module) => ({ default: module.EnlargedFigure })));
const FigureMenu = lazy(() => import("./FigureMenu").then((module) => ({ default: module.FigureMenu })));

type Pressed = Pick<
  ComponentProps<"button">,
  "aria-label" | "aria-expanded" | "onClick" | "onPointerEnter" | "children"
>;

const FigureIcon = (props: Pressed) => (
  <ActionIcon size={24} variant="subtle" color="gray" data-unprinted aria-haspopup="dialog" {...props} />
);

interface EnlargeProps {
  readonly template: FigureTemplate;
  readonly curves: CurvesSource;
}

/** Opens a panel as large as the window. */
export function EnlargeButton({ template, curves }: EnlargeProps) {
  const [opened, { open, close }] = useDisclosure(false);
  const { title } = template.layout.meta;
  const button = useMemo(
    () => (
      <FigureIcon aria-label={`Enlarge figure: ${title}`} onPointerEnter={requestPlotly} onClick={open}>
        <Icon name="Maximize" size={15} />
      </FigureIcon>
    ),
    [title, open],
  );
  return (
    <>
      {button}
      {opened && (
        <LazyPart onClose={close}>
          <EnlargedFigure {...{ template, curves }} onClose={close} />
        </LazyPart>
      )}
    </>
  );
}

export function FigureButton({ source }: { readonly source: FigureSource }) {
  const [requested, setRequested] = useState(false);
  const [opened, setOpened] = useState(false);
  const { title } = source;
  // Curves change with every move of a slider, the button does not.
  const button = useMemo(
    () => (
      <FigureIcon
        aria-label={`Save figure: ${title}`}
        aria-expanded={opened}
        onClick={() => {
          setRequested(true);
          setOpened(!opened);
        }}
      >
        <Icon name="Download" size={15} />
      </FigureIcon>
    ),
    [title, opened],
  );
  if (!requested) return button;
  return (
    <LazyPart
      fallback={button}
      onClose={() => {
        setRequested(false);
        setOpened(false);
      }}
    >
      <FigureMenu source={source} opened={opened} onChange={setOpened}>
        {button}
      </FigureMenu>
    </LazyPart>
  );
}
