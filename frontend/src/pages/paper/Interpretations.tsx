/** Both named sets of readings side by side: what the cells come to under each, and how near they come. */

import { Box, Button } from "@mantine/core";
import type { Paper, PaperInterpretation } from "../../api/types";
import { withSet, type Choices } from "./choices";
import { typeset } from "./numbers";
import ui from "../../ui/ui.module.css";
import { DataTable, type Column } from "../../ui/DataTable";

interface Props {
  readonly paper: Paper;
  readonly choices: Choices;
  readonly onChoose: (choices: Choices) => void;
}

interface Share {
  readonly reached: number;
  readonly total: number;
}

export function Interpretations({ paper, choices, onChoose }: Props) {
  return (
    <DataTable
      label="Both interpretations"
      card
      attributes={{ "data-testid": "interpretations" }}
      rows={paper.interpretations}
      rowKey={({ id }) => id}
      rowAttributes={({ id }) => ({
        "data-interpretation": id,
        "aria-current": id === paper.interpretation || undefined,
      })}
      columns={columnsOf(paper, (id) => onChoose(withSet(choices, paper.readings, id)))}
    />
  );
}

function columnsOf(paper: Paper, onShow: (id: string) => void): readonly Column<PaperInterpretation>[] {
  return [
    {
      key: "interpretation",
      head: "Interpretation",
      text: true,
      cell: ({ title, description }) => (
        <Box miw="7rem" maw="30rem">
          <b>{title}</b>
          <span className={ui.under}>{typeset(description)}</span>
        </Box>
      ),
    },
    { key: "reached", head: "Reached", cell: (item) => <Of reached={item.reached} total={item.total} /> },
    { key: "simulated", head: "Simulated changes", cell: ({ simulated }) => <Of {...simulated} /> },
    {
      key: "ecu",
      head: <>On the ECU, by ±8&nbsp;%</>,
      cell: ({ ecu }) => (paper.complete && ecu.total === 0 ? "not available" : <Of {...ecu} />),
    },
    {
      key: "within",
      head: "Within ±10 points",
      cell: ({ agreement }) => <Of reached={agreement.within} total={agreement.cells} />,
    },
    {
      key: "interval",
      head: "In our interval",
      cell: ({ agreement }) => <Of reached={agreement.in_interval} total={agreement.cells} />,
    },
    {
      key: "show",
      head: <span className="visually-hidden">Show it</span>,
      unprinted: true,
      cell: ({ id, title }) => (
        <Button
          size="compact-xs"
          disabled={id === paper.interpretation}
          aria-label={`Show ${title}`}
          onClick={() => onShow(id)}
        >
          {id === paper.interpretation ? "Shown" : "Show"}
        </Button>
      ),
    },
  ];
}

function Of({ reached, total }: Share) {
  if (total === 0) return "–";
  return (
    <>
      <b>{reached}</b> of {total}
    </>
  );
}
