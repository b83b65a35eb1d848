/** A page beside the lab: its title, its tools and what it shows, which its route has fetched; and what stands in place of results. */

import { Stack, Box, Text, Button, Skeleton } from "@mantine/core";
import { useDocumentTitle } from "@mantine/hooks";
import { type ReactNode, createContext, use } from "react";
import { createPortal } from "react-dom";
import ui from "./ui.module.css";
import shell from "./shell.module.css";

/** A column of cards. */
const MAIN = {
  gap: "0.7rem",
  maw: "96rem",
  mx: "auto",
  p: { base: "0.7rem 0.6rem 4rem", sm: "0.9rem 1rem 3rem" },
};

interface Props {
  /** Of the tab. */
  readonly title: string;
  /** On the page; the title where it is left out. */
  readonly heading?: string;
  readonly above?: ReactNode;
  readonly lead?: ReactNode;
  readonly tools?: ReactNode;
  /** Something of it is still on its way. */
  readonly busy?: boolean;
  readonly children: ReactNode;
}

export function Page({ title, heading = title, above, lead, tools, busy, children }: Props) {
  useDocumentTitle(`${title} · Ridelab`);
  return (
    <>
      {tools !== undefined && (
        <ShellSlot name="tools">
          <span className={shell.grow} />
          {tools}
        </ShellSlot>
      )}
      <Stack component="main" {...MAIN} aria-busy={busy}>
        {above}
        <Box component="h1" m={0} fz="xl" fw={680}>
          {heading}
        </Box>
        {lead !== undefined && <Text className={ui.lead ?? ""}>{lead}</Text>}
        {children}
      </Stack>
    </>
  );
}

/** Until what the page needs is there. */
export function PageLoading() {
  useDocumentTitle("Ridelab");
  return (
    <Stack component="main" {...MAIN}>
      <Loading label="Loading the page" heights={[28, 96, 440]} />
    </Stack>
  );
}

/** What a page puts into the shell around it: its tools in the header, its notices over the page's foot. */
export type Slot = "tools" | "notices";

export const SlotsContext = createContext<Readonly<Record<Slot, HTMLElement | null>>>({ tools: null, notices: null });

export function ShellSlot({ name, children }: { readonly name: Slot; readonly children: ReactNode }) {
  const element = use(SlotsContext)[name];
  return element && createPortal(children, element);
}

interface BlankProps {
  readonly title: string;
  readonly text: string;
  /** What leads on. */
  readonly action?: { readonly label: string; readonly onClick: () => void };
  readonly children?: ReactNode;
}

/** Nothing chosen, nothing found, nothing yet. */
export function Blank({ title, text, action, children }: BlankProps) {
  return (
    <Stack className={ui.card ?? ""} align="center" justify="center" gap="0.7rem" mih="26rem" p="2rem">
      <svg width="180" height="46" viewBox="0 0 180 46" aria-hidden>
        <path
          d="M2 40h58c14 0 18-30 30-30s16 30 30 30h58"
          fill="none"
          stroke="var(--accent)"
          strokeWidth={3}
          strokeLinecap="round"
        />
      </svg>
      <Text component="h2" fw={650} size="lg" ta="center">
        {title}
      </Text>
      <Text c="dimmed" maw={420} ta="center">
        {text}
      </Text>
      {action && (
        <Button size="sm" variant="filled" onClick={action.onClick}>
          {action.label}
        </Button>
      )}
      {children}
    </Stack>
  );
}

/** The places of what is on its way. */
export function Loading({ label, heights }: { readonly label: string; readonly heights: readonly number[] }) {
  return (
    <div className={ui.stack} aria-busy aria-label={label}>
      {heights.map((height, index) => (
        <Skeleton key={index} height={height} radius={8} />
      ))}
    </div>
  );
}
