/** The rules the verdicts follow, and what is printed in the paper but read otherwise here. */

import { Fragment } from "react";
import type { Paper } from "../../api/types";
import classes from "./paper.module.css";
import { VerdictMark, VERDICTS } from "./Verdict";
import { DataTable } from "../../ui/DataTable";
import { typeset } from "./numbers";

/** What the other rules are about. */
const ABOUT: Readonly<Record<string, string>> = {
  hil: "Hardware in the loop",
  mean: "Ours",
  ci: "Interval",
  certain: "Certain",
  misprint: "Misprint",
};

export function Rules({ rules }: Pick<Paper, "rules">) {
  const of = (key: string) => VERDICTS.find(({ verdict }) => verdict === key)?.verdict;
  return (
    <dl className={classes.rules}>
      {Object.entries(rules).map(([key, rule]) => {
        const verdict = of(key);
        return (
          <div key={key}>
            <dt>{verdict ? <VerdictMark verdict={verdict} certain /> : (ABOUT[key] ?? key)}</dt>
            <dd>
              <Inline text={rule} />
            </dd>
          </div>
        );
      })}
    </dl>
  );
}

export function Errata({ errata }: Pick<Paper, "errata">) {
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

const PART = /(`[^`]+`|\*\*[^*]+\*\*|\*[^*]+\*)/;

/** A line of the server's Markdown: `code`, **bold** and *emphasis*; anything else stands as it is. */
export function Inline({ text }: { readonly text: string }) {
  return (
    <>
      {text.split(PART).map((part, index) => (
        <Fragment key={index}>{styled(part)}</Fragment>
      ))}
    </>
  );
}

function styled(part: string) {
  if (part.length > 2 && part.startsWith("`") && part.endsWith("`")) return <code>{part.slice(1, -1)}</code>;
  if (part.length > 4 && part.startsWith("**") && part.endsWith("**")) return <b>{part.slice(2, -2)}</b>;
  if (part.length > 2 && part.startsWith("*") && part.endsWith("*")) return <em>{part.slice(1, -1)}</em>;
  return typeset(part);
}
