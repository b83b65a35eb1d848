/** Where the paper leaves something open, the reader chooses; the rest of the page follows. */

import { Button, SegmentedControl, Text } from "@mantine/core";
import { IconRestore } from "../icons";
import { useId } from "react";
import type { Paper, PaperReading } from "../api/types";
import { count } from "../units/format";
import { changedReadings, withChoice, withoutChoices, type Choices } from "./choices";
import { Inline } from "./Inline";
import { typeset } from "./numbers";
import classes from "./switches.module.css";
import { VerdictCountList } from "./Verdict";

interface Props {
  readonly paper: Paper;
  readonly choices: Choices;
  /** The answer to the choices is not there yet. */
  readonly waiting: boolean;
  readonly onChoose: (choices: Choices) => void;
}

export function Switches({ paper, choices, waiting, onChoose }: Props) {
  // The address is ahead of the answer: a switch stands where it was put.
  const readings = paper.readings.map((reading) => ({ ...reading, chosen: chosenOf(reading, choices) }));
  const changed = changedReadings(readings);
  return (
    <>
      <div className={classes.state} role="status">
        <Text size="sm" fw={600}>
          {waiting ? "Counting under these readings …" : `Of ${count(paper.total, "cell")}:`}
        </Text>
        <span data-stale={waiting || undefined}>
          <VerdictCountList counts={paper.counts} />
        </span>
        <Button
          size="compact-xs"
          variant="default"
          leftSection={<IconRestore size={14} aria-hidden />}
          disabled={changed.length === 0}
          onClick={() => onChoose(withoutChoices(choices, readings))}
        >
          {changed.length === 0 ? "All as Ridelab reads it" : `Reset ${count(changed.length, "switch", "switches")}`}
        </Button>
      </div>
      <div className={classes.grid}>
        {readings.map((reading) => (
          <Switch key={reading.id} reading={reading} onChange={(choice) => onChoose(withChoice(choices, reading, choice))} />
        ))}
      </div>
    </>
  );
}

function chosenOf({ id, choices: offered, chosen }: PaperReading, choices: Choices): string {
  const wanted = choices[id] ?? offered.find(({ default: standard }) => standard)?.id;
  return offered.find((choice) => choice.id === wanted)?.id ?? chosen;
}

function Switch({ reading, onChange }: { readonly reading: PaperReading; readonly onChange: (choice: string) => void }) {
  const id = useId();
  const standard = reading.choices.find((choice) => choice.default);
  const isChanged = standard?.id !== reading.chosen;
  return (
    <div className={classes.switch} data-changed={isChanged || undefined} data-reading={reading.id}>
      <div className={classes.head}>
        <h3 id={id} className={classes.title}>
          {typeset(reading.title)}
        </h3>
        {isChanged && standard && <span className={classes.changed}>Ridelab’s: {typeset(standard.label)}</span>}
      </div>
      <p className={classes.description}>
        <Inline text={reading.description} />
      </p>
      <SegmentedControl
        size="xs"
        aria-labelledby={id}
        className={classes.control ?? ""}
        value={reading.chosen}
        data={reading.choices.map((choice) => ({ value: choice.id, label: typeset(choice.label) }))}
        onChange={onChange}
      />
    </div>
  );
}
