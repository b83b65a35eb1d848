/** A page beside the lab: its title, its tools and what it shows, which its route has fetched. */

import { Box, Text } from "@mantine/core";
import { useDocumentTitle } from "@mantine/hooks";
import { type ReactNode, createContext, use } from "react";
import { createPortal } from "react-dom";
import { Loading } from "./Blank";
import ui from "./ui.module.css";
import shell from "./shell.module.css";

interface Props {
  /** Of the tab. */
  readonly title: string;
  /** On the page; the title where it is left out. */
  readonly heading?: string;
  readonly above?: ReactNode;
  readonly lead?: ReactNode;
  readonly tools?: ReactNode;
  readonly children: ReactNode;
}

export function Page({ title, heading = title, above, lead, tools, children }: Props) {
  useDocumentTitle(`${title} · Ridelab`);
  return (
    <>
      {tools !== undefined && (
        <ShellSlot name="tools">
          <span className={shell.grow} />
          {tools}
        </ShellSlot>
      )}
      <main className={ui.main}>
        {above}
        <Box component="h1" m={0} fz="xl" fw={680}>
          {heading}
        </Box>
        {lead !== undefined && <Text className={ui.lead ?? ""}>{lead}</Text>}
        {children}
      </main>
    </>
  );
}

/** Until what the page needs is there. */
export function PageLoading() {
  useDocumentTitle("Ridelab");
  return (
    <main className={ui.main}>
      <Loading label="Loading the page" heights={[28, 96, 440]} />
    </main>
  );
}

/** What a page puts into the shell around it: its tools in the header, its notices over the page's foot. */
export type Slot = "tools" | "notices";

export const SlotsContext = createContext<Readonly<Record<Slot, HTMLElement | null>>>({ tools: null, notices: null });

export function ShellSlot({ name, children }: { readonly name: Slot; readonly children: ReactNode }) {
  const element = use(SlotsContext)[name];
  return element && createPortal(children, element);
}
