/** Navigation between the pages: links where there is room, else a menu under the name of the page shown. */

import { Link, linkOptions, useNavigate, useRouterState, useSearch } from "@tanstack/react-router";
import { lazy } from "react";
import { firstCurves } from "../lib/firstCurves";
import { LazyPart } from "../ui/LazyPart";
import { MANUAL } from "../ui/manual";
import type { Address } from "../lab/address";
import { usePaletteEntries } from "../lab/actions";
import { useLabContext, useLab } from "../lab/context";
import { labLink } from "../lab/labAddress";
import { useSelector } from "@tanstack/react-store";
import { Box, Group } from "@mantine/core";
import classes from "../ui/shell.module.css";
import ui from "../ui/ui.module.css";

const PagesMenu = lazy(async () => ({ default: (await firstCurves.then(() => import("./headerParts"))).PagesMenu }));

/** The run whose scenario other pages start with: the page's own, else the lab's, which is known before its curves are. */
function useRun(lab: Address): { readonly run?: string } {
  const { run } = useSearch({ strict: false });
  const exists = useLab((state) => state.failure?.kind !== "notFound");
  const shown = useLab((state) => state.shown?.runId ?? null);
  const id = run ?? (exists ? lab.runId : null) ?? shown;
  return id === null ? {} : { run: id };
}

const HOME = { display: "flex", alignItems: "center", gap: "0.5rem", color: "inherit", textDecoration: "none" };

/** What people may look for a page by. */
const SEARCH_WORDS: Readonly<Record<string, readonly string[]>> = {
  paper: ["reproduction", "claims", "tables"],
  sweeps: ["batch", "grid", "parameter", "study"],
  tuner: ["optimise", "optimize", "weights", "comfort"],
  robustness: ["monte", "carlo", "uncertainty", "tolerance"],
  ecu: ["hardware", "hil", "microcontroller"],
};

export function Nav() {
  const lab = useSelector(useLabContext().labAddress);
  const search = useRun(lab);
  const entries = [
    { section: "lab", label: "Lab", link: labLink(lab) },
    { section: "paper", label: "Paper", link: linkOptions({ to: "/paper" }) },
    { section: "sweeps", label: "Sweeps", link: linkOptions({ to: "/sweeps" }) },
    { section: "tuner", label: "Tuner", link: linkOptions({ to: "/tuner", search }) },
    { section: "robustness", label: "Robustness", link: linkOptions({ to: "/robustness", search }) },
    { section: "ecu", label: "ECU", link: linkOptions({ to: "/ecu", search }) },
  ];
  const path = useRouterState({ select: ({ matches }) => matches[1]?.routeId.split("/")[1] });
  const section = path === "b" ? "sweeps" : path;
  // The lab has more in its header.
  const width = section === "lab" ? "lg" : "sm";
  const navigate = useNavigate();
  usePaletteEntries([
    ...entries.map(({ section, label, link }) => ({
      group: "Pages" as const,
      label,
      searchWords: SEARCH_WORDS[section],
      run: () => void navigate(link),
    })),
    { group: "Pages", label: "Manual", run: () => void window.open(MANUAL, "_blank", "noopener") },
  ]);
  return (
    <>
      <Link {...labLink(lab)} style={HOME} aria-label="Ridelab, to the lab">
        <Logo />
        <Box component="span" mr="0.6rem" fz="lg" fw={700} lts="-0.01em" visibleFrom="sm">
          Ridelab
        </Box>
      </Link>
      <Group component="nav" gap={0} wrap="nowrap" flex="none" aria-label="Pages">
        <Group component="ul" className={ui.list ?? ""} gap="0.1rem" wrap="nowrap" visibleFrom={width}>
          {entries.map(({ label, link, ...entry }) => (
            <li key={label}>
              <Link
                {...link}
                className={classes.link}
                aria-current={entry.section === section ? "page" : undefined}
                activeProps={{}}
              >
                {label}
              </Link>
            </li>
          ))}
        </Group>
        <LazyPart>
          <PagesMenu {...{ entries, section }} hiddenFrom={width} />
        </LazyPart>
      </Group>
    </>
  );
}

function Logo() {
  return (
    <svg width="26" height="26" viewBox="0 0 32 32" aria-hidden style={{ flex: "none" }}>
      <rect width="32" height="32" rx="7" fill="#0b6e6e" />
      <path
        d="M3 24h6c3 0 4-8 7-8s4 8 7 8h6"
        fill="none"
        stroke="#fff"
        strokeWidth="2.6"
        strokeLinecap="round"
        strokeLinejoin="round"
      />
      <circle cx="16" cy="9.5" r="4" fill="none" stroke="#fff" strokeWidth="2.6" />
    </svg>
  );
}
