/** A page beside the lab: its title and tools, and in place of what it shows why that is not there. */

import { Box, Text } from "@mantine/core";
import { useDocumentTitle } from "@mantine/hooks";
import { type ReactNode, createContext, use } from "react";
import { createPortal } from "react-dom";
import { isNotFound, isTransient } from "../api/problem";
import { Loading, Blank, CouldNotLoad } from "./Blank";
import ui from "./ui.module.css";
import shell from "./shell.module.css";

interface Props {
  /** Of the tab. */
  readonly title: string;
  /** On the page, once it can be said. */
  readonly heading?: string | undefined;
  readonly above?: ReactNode;
  readonly lead?: ReactNode;
  readonly tools?: ReactNode;
  /** What is shown, such as `sweep`. */
  readonly what: string;
  /** Leads on where there is none at the address. */
  readonly instead?: ReactNode;
  readonly faults: readonly (Error | null | undefined)[];
  readonly heights?: readonly number[];
  /** `null` until all it needs is there. */
  readonly children: ReactNode;
}

export function Page({ title, heading, above, lead, tools, what, instead, faults, heights = [], children }: Props) {
  useDocumentTitle(`${title} · Ridelab`);
  const fault = faults.find((error) => error && !isTransient(error));
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
        {heading !== undefined && (
          <Box component="h1" m={0} fz="xl" fw={680}>
            {heading}
          </Box>
        )}
        {lead !== undefined && <Text className={ui.lead ?? ""}>{lead}</Text>}
        {!fault ? (
          (children ?? <Loading label={`Loading the ${what}`} heights={heights} />)
        ) : instead !== undefined && isNotFound(fault) ? (
          <Blank
            title={`There is no ${what} at this address`}
            text={`The address may be incomplete, or the ${what} was made on another server.`}
          >
            {instead}
          </Blank>
        ) : (
          <CouldNotLoad what={what} message={fault.message} />
        )}
      </main>
    </>
  );
}

/** What a page puts into the shell around it: its tools in the header, its notices over the page's foot. */
export type Slot = "tools" | "notices";

export const SlotsContext = createContext<Readonly<Record<Slot, HTMLElement | null>>>({ tools: null, notices: null });

export function ShellSlot({ name, children }: { readonly name: Slot; readonly children: ReactNode }) {
  const element = use(SlotsContext)[name];
  return element && createPortal(children, element);
}
