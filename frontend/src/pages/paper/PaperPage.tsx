/** The paper, checked: what it prints beside what comes out here. */

import { Anchor, Box, Button } from "@mantine/core";
import { useWindowEvent } from "@mantine/hooks";
import { useQuery } from "@tanstack/react-query";
import { useEffect, type ReactNode, useState } from "react";
import { Icon } from "../../ui/icons";
import { download } from "../../lib/download";
import { address } from "../../api/http";
import { ApiProblem, isTransient } from "../../api/problem";
import type { Paper } from "../../api/types";
import { Page } from "../../ui/Page";
import { NONE_CHOSEN, useChoices } from "./choices";
import { Contributions } from "./Contributions";
import { CountSection } from "./CountSection";
import { Figures } from "./Figures";
import classes from "./paper.module.css";
import { paperQuery, Fault, Waiting } from "./Waiting";
import { Inline, SwitchEffects, Switches } from "./Switches";
import { Tables } from "./Tables";
import { FileMenu } from "../../features/export/FileMenu";
import { ShareAddress } from "../../features/share/ShareLink";
import ui from "../../ui/ui.module.css";
import { VerdictBar, countedOf, soFar, VerdictMark, VERDICTS } from "./Verdict";
import { DataTable } from "../../ui/DataTable";

const DOI = "10.3390/wevj16040232";

export function PaperPage() {
  const [choices, choose] = useChoices();
  const { data: paper, error: refused, isPlaceholderData: waiting, refetch } = useQuery(paperQuery(choices));
  useArrival(paper !== undefined);
  // While it is asked for again and again, one refusal that passes is none.
  const fault = paper?.complete === false && refused !== null && isTransient(refused) ? null : refused;
  const unknown = fault instanceof ApiProblem && fault.status === 422;
  return (
    <Page
      title="The paper, checked"
      busy={waiting || paper?.complete === false}
      lead={
        <>
          Meng, Kong, Ding, Liu and Wang,{" "}
          <Anchor href={`https://doi.org/${DOI}`}>World Electric Vehicle Journal 16 (2025) 232</Anchor>: every change it
          prints, run here again.
        </>
      }
      tools={
        <>
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
        </>
      }
    >
      <div className={classes.page}>
        <Contents paper={paper} />
        <Box miw={0}>
          {fault && (
            <Fault
              message={
                unknown
                  ? "This address names an interpretation, a reading or a choice that this server does not know."
                  : fault.message
              }
              onRetry={() => void refetch()}
            />
          )}
          {fault && Object.keys(choices).length > 0 && (
            <Button mt="0.6rem" onClick={() => choose(NONE_CHOSEN)}>
              Show Ridelab’s own interpretation
            </Button>
          )}
          {paper ? <Sections {...{ paper, waiting }} /> : !fault && <Waiting what="Looking up the runs" height={600} />}
        </Box>
      </div>
    </Page>
  );
}

interface SectionsProps {
  readonly paper: Paper;
  readonly waiting: boolean;
}

function Sections({ paper, waiting }: SectionsProps) {
  const parts: Readonly<Record<SectionId, ReactNode>> = {
    count: <CountSection paper={paper} />,
    switches: (
      <>
        <Switches {...{ paper, waiting }} />
        <h3 className={classes.subtitle}>What each switch does</h3>
        <SwitchEffects paper={paper} />
      </>
    ),
    tables: <Tables paper={paper} />,
    parts: <Contributions enabled={paper.complete} />,
    figures: <Figures />,
    errata: <Errata errata={paper.errata} />,
    rules: <Rules rules={paper.rules} />,
  };
  const follows: readonly SectionId[] = ["count", "tables"];
  return SECTIONS.map(({ id, title }) => (
    <section
      key={id}
      id={id}
      className={`${classes.section} ${ui.follows}`}
      aria-labelledby={`${id}-title`}
      data-stale={(waiting && follows.includes(id)) || undefined}
    >
      <h2 id={`${id}-title`} className={classes.heading}>
        {title}
      </h2>
      {parts[id]}
    </section>
  ));
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

function Contents({ paper }: { readonly paper: Paper | undefined }) {
  const active = useSection();
  return (
    <nav className={classes.contents} data-unprinted aria-label="On this page">
      <ol className={`${ui.list} ${classes.list}`}>
        {SECTIONS.map(({ id, title }, index) => (
          <li key={id}>
            <a href={`#${id}`} className={classes.link} aria-current={index === active ? "location" : undefined}>
              {title}
            </a>
          </li>
        ))}
      </ol>
      {paper && (
        <Box className={classes.count} mt="1rem" pl="0.7rem">
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
          <Box mt="0.35rem">
            <VerdictBar counts={paper.counts} total={countedOf(paper, paper.counts)} />
          </Box>
        </Box>
      )}
    </nav>
  );
}

/** A heading counts as reached when it is this near to the window's top [px]. */
const REACHED = 120;

/** Index of the last section whose top has been reached; 0 above the first. */
function useSection(): number {
  const [section, setSection] = useState(0);
  useWindowEvent("scroll", () => {
    const reached = SECTIONS.findLastIndex(
      ({ id }) => (document.getElementById(id)?.getBoundingClientRect().top ?? Infinity) < REACHED,
    );
    const atEnd = window.innerHeight + window.scrollY >= document.documentElement.scrollHeight - 2;
    setSection(atEnd && window.scrollY > 0 ? SECTIONS.length - 1 : Math.max(0, reached));
  });
  return section;
}

/** What the other rules are about. */
const ABOUT: Readonly<Record<string, string>> = {
  hil: "Hardware in the loop",
  mean: "Ours",
  ci: "Interval",
  certain: "Certain",
  misprint: "Misprint",
};

function Rules({ rules }: Pick<Paper, "rules">) {
  return (
    <DataTable
      label="Rules of the verdicts"
      card
      rows={Object.entries(rules)}
      rowKey={([key]) => key}
      columns={[
        {
          key: "about",
          head: "About",
          text: true,
          cell: ([key]) => {
            const verdict = VERDICTS.find((each) => each.verdict === key)?.verdict;
            return verdict ? <VerdictMark verdict={verdict} certain /> : (ABOUT[key] ?? key);
          },
        },
        { key: "rule", head: "Rule", text: true, cell: ([, rule]) => <Inline text={rule} /> },
      ]}
    />
  );
}

function Errata({ errata }: Pick<Paper, "errata">) {
  return (
    <DataTable
      label="What is printed, what is used here"
      card
      attributes={{ "data-testid": "errata" }}
      rows={errata}
      rowKey={({ place, printed }) => `${place} ${printed}`}
      columns={(["place", "printed", "here"] as const).map((key) => ({
        key,
        head: { place: "Place", printed: "Printed", here: "Here" }[key],
        text: true,
        headAttributes: { style: { minWidth: "14rem" } },
        cell: (erratum: Paper["errata"][number]) => <Inline text={erratum[key]} />,
      }))}
    />
  );
}
