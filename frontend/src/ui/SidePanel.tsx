/** A panel beside the plots, which make room for it; Escape closes it. */

import { CloseButton, Group, Stack } from "@mantine/core";
import { useWindowEvent } from "@mantine/hooks";
import { useLayoutEffect, useRef, type ReactNode } from "react";
import { Card } from "./Card";
import ui from "./ui.module.css";

const HEAD = {
  position: "sticky",
  top: 0,
  zIndex: 1,
  borderBottom: "1px solid var(--line)",
  background: "var(--surface)",
} as const;

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
  useLayoutEffect(() => {
    const main = ref.current?.closest("main");
    main?.toggleAttribute("data-beside", true);
    return () => main?.removeAttribute("data-beside");
  }, []);
  useWindowEvent("keydown", (event) => {
    if (event.key === "Escape" && !event.defaultPrevented) onClose();
  });
  return (
    <Card ref={ref} className={ui.sidePanel} data-unprinted aria-label={title} {...rest}>
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
