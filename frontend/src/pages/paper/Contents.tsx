/** The page's sections: beside them where there is room, else above them. */

import { Box } from "@mantine/core";
import { useEffect, useState } from "react";
import type { Paper } from "../../api/types";
import classes from "./contents.module.css";
import { VerdictBar, countedOf, soFar } from "./Verdict";

export const SECTIONS = [
  { id: "count", title: "Summary" },
  { id: "switches", title: "Switches" },
  { id: "tables", title: "Tables 4–10" },
  { id: "parts", title: "What each part contributes" },
  { id: "figures", title: "Figures" },
  { id: "errata", title: "Errata" },
  { id: "rules", title: "Rules" },
] as const;

export type SectionId = (typeof SECTIONS)[number]["id"];

const IDS = SECTIONS.map(({ id }) => id);

export function Contents({ paper }: { readonly paper: Paper | undefined }) {
  const active = useSection(IDS);
  return (
    <nav className={classes.contents} data-unprinted aria-label="On this page">
      <ol className={classes.list}>
        {SECTIONS.map(({ id, title }, index) => (
          <li key={id}>
            <a href={`#${id}`} className={classes.link} aria-current={index === active ? "location" : undefined}>
              {title}
            </a>
          </li>
        ))}
      </ol>
      {paper && (
        <div className={classes.count}>
          <b>{paper.reached}</b> of {countedOf(paper, paper.counts)} reached{soFar(paper)}
          {paper.interpretations
            .filter(({ id }) => id !== paper.interpretation)
            .map(({ id, title, reached, total }) => (
              <Box component="span" key={id} display="block" fz="xs" c="dimmed">
                {title}: {reached} of {paper.complete ? total : paper.cells.length}
              </Box>
            ))}
          {paper.unavailable && (
            <Box component="span" display="block" fz="xs" c="dimmed">
              {paper.unavailable.cells} not available here
            </Box>
          )}
          <VerdictBar counts={paper.counts} total={countedOf(paper, paper.counts)} />
        </div>
      )}
    </nav>
  );
}

/** A heading counts as reached when it is this near to the window's top [px]. */
const REACHED = 120;

/** Index of the last of these elements whose top has been reached; 0 above the first. */
function useSection(ids: readonly string[]): number {
  const [section, setSection] = useState(0);
  useEffect(() => {
    let frame = 0;
    const look = () => {
      frame = 0;
      const tops = ids.map((id) => document.getElementById(id)?.getBoundingClientRect().top ?? Infinity);
      const atEnd = window.innerHeight + window.scrollY >= document.documentElement.scrollHeight - 2;
      setSection(
        atEnd && window.scrollY > 0
          ? ids.length - 1
          : Math.max(
              0,
              tops.findLastIndex((top) => top < REACHED),
            ),
      );
    };
    const onScroll = () => {
      if (frame === 0) frame = requestAnimationFrame(look);
    };
    window.addEventListener("scroll", onScroll, { passive: true });
    return () => {
      window.removeEventListener("scroll", onScroll);
      cancelAnimationFrame(frame);
    };
  }, [ids]);
  return section;
}
