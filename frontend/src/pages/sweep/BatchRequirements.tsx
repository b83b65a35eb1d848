/** How a sweep's runs keep what is required of them, and where one first does not. */

import { Button } from "@mantine/core";
import type { BatchRequirements as Answer } from "../../api/types";
import { limitText } from "../../features/requirements/judged";
import { ResultMark } from "../../features/requirements/RequirementMarks";
import { fullName } from "../../server/metrics";
import { Card } from "../../ui/Card";
import { DataTable, type Column } from "../../ui/DataTable";
import { fieldTexts } from "./describeRow";
import type { SweepParts } from "./shownPlot";

type Result = Answer["requirement_results"][number];

interface Props extends Pick<SweepParts, "columns" | "strategies" | "figures" | "onOpen"> {
  readonly results: readonly Result[];
  readonly fields: SweepParts["batch"]["fields"];
}

export function BatchRequirements({ results, columns, fields, strategies, figures, onOpen }: Props) {
  const labelOf = (id: string | null) => strategies.find((each) => each.id === id)?.label ?? id;
  const described: readonly Column<Result>[] = [
    {
      key: "requirement",
      head: "Requirement",
      text: true,
      cell: (result) => {
        const figure = figures.find(({ key }) => key === result.metric);
        return `${figure ? fullName(figure) : result.metric} ${limitText(result, figure, labelOf(result.baseline))}`;
      },
    },
    { key: "strategy", head: "Strategy", text: true, cell: ({ strategy }) => labelOf(strategy) },
    { key: "result", head: "Result", text: true, cell: ({ result }) => <ResultMark result={result} /> },
    { key: "fail", head: "Runs that fail", cell: ({ counts }) => counts.fail },
    { key: "not_computed", head: "Not computed", cell: ({ counts }) => counts.not_computed },
    { key: "unfinished", head: "Unfinished", cell: ({ counts }) => counts.unfinished },
    {
      key: "first",
      head: "First failure",
      text: true,
      cell: ({ first_failure: first }) =>
        first ? (
          <Button size="compact-xs" variant="subtle" onClick={() => onOpen(first.run)}>
            {fieldTexts(columns, first.run, fields).join(", ") || `Run ${first.run}`}
          </Button>
        ) : (
          "–"
        ),
    },
  ];
  return (
    <Card aria-label="Requirements" title="Requirements">
      <DataTable
        label="How the runs keep the requirements"
        columns={described}
        rows={results}
        rowKey={(result) => results.indexOf(result)}
        attributes={{ "data-dense": true }}
      />
    </Card>
  );
}
