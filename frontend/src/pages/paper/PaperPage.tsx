/** The paper, checked: what it prints beside what comes out here. */

import { Anchor, Box, Button, Text } from "@mantine/core";
import { useDocumentTitle } from "@mantine/hooks";
import { useQuery } from "@tanstack/react-query";
import { useEffect, type ReactNode, useState } from "react";
import { Icon } from "../../ui/icons";
import { download } from "../../lib/download";
import { address } from "../../api/http";
import { ApiProblem, isTransient } from "../../api/problem";
import type { Paper } from "../../api/types";
import { ShellSlot } from "../../ui/Page";
import shell from "../../ui/shell.module.css";
import { Errata, Rules } from "./Appendix";
import { NONE_CHOSEN, useChoices, type Choices } from "./choices";
import { Contributions } from "./Contributions";
import { CountSection } from "./CountSection";
import { Figures } from "./Figures";
import classes from "./paper.module.css";
import { paperQuery } from "./queries";
import { SwitchEffects } from "./SwitchEffects";
import { Switches } from "./Switches";
import { Tables } from "./Tables";
import { Fault, Waiting } from "./Waiting";
import { FileMenu } from "../../features/export/FileMenu";
import ui from "../../ui/ui.module.css";
import contents from "./contents.module.css";
import { VerdictBar, countedOf, soFar } from "./Verdict";
import { ShareAddress } from "../../features/share/ShareLink";
import { useLabels, type Labels } from "../../server/useCatalogues";

const DOI = "10.3390/wevj16040232";

export function PaperPage() {
  useDocumentTitle("The paper, checked · Ridelab");
  const [choices, choose] = useChoices();
  const { data: paper, error: refused, isPlaceholderData: waiting, refetch } = useQuery(paperQuery(choices));
  const words = useLabels();
  useArrival(paper !== undefined);
  // While it is asked for again and again, one refusal that passes is none.
  const fault = paper?.complete === false && refused !== null && isTransient(refused) ? null : refused;

  return (
    <>
      <ShellSlot name="tools">
        <span className={shell.grow} />
        <ShareAddress what="page" ready />
        <FileMenu
          contents="Every cell, table and picture"
          files={[
            {
              label: "Report (HTML)",
              icon: <Icon name="FileDescription" size={16} />,
              save: () => download(address("/paper/report.html", { query: choices }), "ridelab-paper.html"),
            },
          ]}
        />
      </ShellSlot>
      <div className={classes.page}>
        <Contents paper={paper} />
        <Box component="main" miw={0} aria-busy={waiting || paper?.complete === false}>
          <Box component="header" pt="1.1rem">
            <Box component="h1" m="0 0 0.2rem" fz="xl" fw={700} lts="-0.01em">
              The paper, checked
            </Box>
            <Text className={ui.lead ?? ""} mb="0.6rem">
              Meng, Kong, Ding, Liu and Wang,{" "}
              <Anchor href={`https://doi.org/${DOI}`}>World Electric Vehicle Journal 16 (2025) 232</Anchor>: every
              change it prints, run here again.
            </Text>
          </Box>
          {fault && (
            <PageFault
              fault={fault}
              choices={choices}
              onReset={() => choose(NONE_CHOSEN)}
              onRetry={() => void refetch()}
            />
          )}
          {paper ? (
            <Sections {...{ paper, words, choices, waiting, choose }} />
          ) : (
            !fault && <Waiting what="Looking up the runs" height={600} />
          )}
        </Box>
      </div>
    </>
  );
}

interface SectionsProps {
  readonly paper: Paper;
  readonly words: Labels;
  readonly choices: Choices;
  readonly waiting: boolean;
  readonly choose: (choices: Choices) => void;
}

function Sections({ paper, words, choices, waiting, choose }: SectionsProps) {
  const parts: Readonly<Record<SectionId, ReactNode>> = {
    count: <CountSection {...{ paper, words, choices }} onChoose={choose} />,
    switches: (
      <>
        <Switches {...{ paper, choices, waiting }} onChoose={choose} />
        <h3 className={classes.subtitle}>What each switch does</h3>
        <SwitchEffects {...{ paper, choices }} onChoose={choose} />
      </>
    ),
    tables: <Tables paper={paper} words={words} />,
    parts: <Contributions {...{ choices, words }} enabled={paper.complete} />,
    figures: <Figures choices={choices} />,
    errata: <Errata errata={paper.errata} />,
    rules: <Rules rules={paper.rules} />,
  };
  const follows: readonly SectionId[] = ["count", "tables"];
  return SECTIONS.map(({ id, title }) => (
    <section
      key={id}
      id={id}
      className={classes.section}
      aria-labelledby={`${id}-title`}
      data-section
      data-stale={(waiting && follows.includes(id)) || undefined}
    >
      <h2 id={`${id}-title`} className={classes.heading}>
        {title}
      </h2>
      {parts[id]}
    </section>
  ));
}

interface PageFaultProps {
  readonly fault: Error;
  readonly choices: Choices;
  readonly onReset: () => void;
  readonly onRetry: () => void;
}

function PageFault({ fault, choices, onReset, onRetry }: PageFaultProps) {
  const unknown = fault instanceof ApiProblem && fault.status === 422;
  return (
    <>
      <Fault
        message={
          unknown
            ? "This address names an interpretation, a reading or a choice that this server does not know."
            : fault.message
        }
        onRetry={onRetry}
      />
      {Object.keys(choices).length > 0 && (
        <Button mt="0.6rem" onClick={onReset}>
          Show Ridelab’s own interpretation
        </Button>
      )}
    </>
  );
}

/** The place the address names is there only once the answer is. */
function useArrival(ready: boolean) {
  useEffect(() => {
    const { hash } = window.location;
    if (ready && hash.length > 1) document.getElementById(decodeURIComponent(hash.slice(1)))?.scrollIntoView();
  }, [ready]);
}

const SECTIONS = [
  { id: "count", title: "Summary" },
  { id: "switches", title: "Switches" },
  { id: "tables", title: "Tables 4–10" },
  { id: "parts", title: "What each part contributes" },
  { id: "figures", title: "Figures" },
  { id: "errata", title: "Errata" },
  { id: "rules", title: "Rules" },
] as const;

type SectionId = (typeof SECTIONS)[number]["id"];

const IDS = SECTIONS.map(({ id }) => id);

function Contents({ paper }: { readonly paper: Paper | undefined }) {
  const active = useSection(IDS);
  return (
    <nav className={contents.contents} data-unprinted aria-label="On this page">
      <ol className={`${ui.list} ${contents.list}`}>
        {SECTIONS.map(({ id, title }, index) => (
          <li key={id}>
            <a href={`#${id}`} className={contents.link} aria-current={index === active ? "location" : undefined}>
              {title}
            </a>
          </li>
        ))}
      </ol>
      {paper && (
        <div className={contents.count}>
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
