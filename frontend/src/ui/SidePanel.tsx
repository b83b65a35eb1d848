/** A panel beside the plots, which make room for it; Escape closes it. */

import { CloseButton, Group, Stack } from "@mantine/core";
import { useMediaQuery, useWindowEvent } from "@mantine/hooks";
import { useLayoutEffect, useRef, type ReactNode } from "react";
import { Card } from "./Card";
import ui from "./ui.module.css";

const PANEL = {
  position: "fixed",
  right: "0.6rem",
  bottom: "0.6rem",
  display: "flex",
  flexDirection: "column",
  overflow: "auto",
  boxShadow: "0 4px 18px rgba(0, 0, 0, 0.14)",
} as const;
/** Beside the plots: the cursor that it follows stays in reach. */
const BESIDE = { ...PANEL, top: "calc(var(--header, 3.25rem) + 0.6rem)", zIndex: 20, width: "27rem" };
/** Over the form's sheet, which it is opened from. */
const BELOW = { ...PANEL, left: "0.6rem", zIndex: 210, maxHeight: "48vh" };

const HEAD = {
  position: "sticky",
  top: 0,
  zIndex: 1,
  borderBottom: "1px solid var(--line)",
  background: "var(--surface)",
} as const;

/** What is open over the page closes by itself, and before the panel does. */
const liesOver = (target: EventTarget | null) =>
  target instanceof Element && target.closest("[role=dialog], [role=menu], [role=listbox]") !== null;

interface Props {
  readonly title: string;
  /** What stands beside the title. */
  readonly tools?: ReactNode;
  readonly "data-testid": string;
  readonly onClose: () => void;
  readonly children: ReactNode;
}

export function SidePanel({ title, tools, onClose, children, ...rest }: Props) {
  const ref = useRef<HTMLElement>(null);
  const isNarrow = useMediaQuery("(max-width: 61.99em)", false, { getInitialValueInEffect: false });
  useLayoutEffect(() => {
    const main = ref.current?.closest("main");
    main?.toggleAttribute("data-beside", true);
    return () => main?.removeAttribute("data-beside");
  }, []);
  useWindowEvent("keydown", (event) => {
    if (event.key === "Escape" && !event.defaultPrevented && !liesOver(event.target)) onClose();
  });
  return (
    <Card ref={ref} style={isNarrow ? BELOW : BESIDE} data-unprinted aria-label={title} {...rest}>
      <Group component="header" gap="0.4rem" wrap="nowrap" p="0.4rem 0.5rem 0.4rem 0.9rem" style={HEAD}>
        <h2 className={ui.heading} style={{ flex: 1 }}>
          {title}
        </h2>
        {tools}
        <CloseButton aria-label="Close" onClick={onClose} />
      </Group>
      <Stack gap="0.6rem" p="0.6rem 0.9rem 0.9rem">
        {children}
      </Stack>
    </Card>
  );
}
