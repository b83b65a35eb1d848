/** Both named sets of readings side by side: what the cells come to under each, and how near they come. */

import { Button } from "@mantine/core";
import type { Paper, PaperInterpretation } from "../api/types";
import { withSet, type Choices } from "./choices";
import { typeset } from "./numbers";
import classes from "./tables.module.css";
import { ScrollTable } from "../ui/ScrollTable";

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
    <ScrollTable label="Both interpretations" card className={`${classes.table ?? ""} ${classes.effects ?? ""} ${classes.sets ?? ""}`} data-testid="interpretations">
      <thead>
        <tr>
          <th scope="col">Interpretation</th>
          <th scope="col" className={classes.number}>
            Reached
          </th>
          <th scope="col" className={classes.number}>
            Simulated changes
          </th>
          <th scope="col" className={classes.number}>
            On the ECU, by ±8&nbsp;%
          </th>
          <th scope="col" className={classes.number}>
            Within ±10 points
          </th>
          <th scope="col" className={classes.number}>
            In our interval
          </th>
          <th scope="col" className={classes.unprinted}>
            <span className="visually-hidden">Show it</span>
          </th>
        </tr>
      </thead>
      <tbody>
        {paper.interpretations.map((item) => (
          <Row
            key={item.id}
            item={item}
            complete={paper.complete}
            shown={item.id === paper.interpretation}
            onShow={() => onChoose(withSet(choices, paper.readings, item.id))}
          />
        ))}
      </tbody>
    </ScrollTable>
  );
}

interface RowProps extends Pick<Paper, "complete"> {
  readonly item: PaperInterpretation;
  readonly shown: boolean;
  readonly onShow: () => void;
}

function Row({ item, complete, shown, onShow }: RowProps) {
  const { agreement, ecu } = item;
  return (
    <tr data-interpretation={item.id} aria-current={shown || undefined}>
      <th scope="row" className={classes.setName}>
        <b>{item.title}</b>
        <span className={classes.setText}>{typeset(item.description)}</span>
      </th>
      <td className={classes.number}>
        <Of reached={item.reached} total={item.total} />
      </td>
      <td className={classes.number}>
        <Of {...item.simulated} />
      </td>
      <td className={classes.number}>{complete && ecu.total === 0 ? "not available" : <Of {...ecu} />}</td>
      <td className={classes.number}>
        <Of reached={agreement.within} total={agreement.cells} />
      </td>
      <td className={classes.number}>
        <Of reached={agreement.in_interval} total={agreement.cells} />
      </td>
      <td className={classes.unprinted}>
        <Button size="compact-xs" variant="default" disabled={shown} aria-label={`Show ${item.title}`} onClick={onShow}>
          {shown ? "Shown" : "Show"}
        </Button>
      </td>
    </tr>
  );
}

function Of({ reached, total }: Share) {
  if (total === 0) return "–";
  return (
    <>
      <b>{reached}</b> of {total}
    </>
  );
}
