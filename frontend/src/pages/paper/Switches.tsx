/** Where the paper leaves something open, the reader chooses; the rest of the page follows. */

import { Box, Button, Group, SegmentedControl, Text } from "@mantine/core";
import { useId } from "react";
import { Icon } from "../../ui/icons";
import type { Paper, PaperInterpretation, PaperReading } from "../../api/types";
import { count } from "../../units/format";
import { setOf, standardOf, withChoice, withoutChoices, type Choices } from "./choices";
import { Inline } from "./Appendix";
import { typeset } from "./numbers";
import classes from "./switches.module.css";
import { VerdictCountList, countedOf, soFar } from "./Verdict";
import ui from "../../ui/ui.module.css";
import { Columns } from "../../ui/Card";

interface Props {
  readonly paper: Paper;
  readonly choices: Choices;
  /** The answer to the choices is not there yet. */
  readonly waiting: boolean;
  readonly onChoose: (choices: Choices) => void;
}

export function Switches({ paper, choices, waiting, onChoose }: Props) {
  // The address is ahead of the answer: a switch stands where it was put.
  const set = setOf(choices, paper.interpretations);
  const readings = paper.readings.map((reading) => ({ ...reading, chosen: choiceOf(reading, choices, set) }));
  const changed = readings.filter((reading) => reading.chosen !== standardOf(reading, set));
  return (
    <>
      <Group gap="0.4rem 1.1rem" mih="2rem" mb="0.6rem" role="status">
        <Text fw={600}>
          {waiting
            ? "Counting under these interpretations…"
            : `Of ${count(countedOf(paper, paper.counts), "cell")}${soFar(paper)}:`}
        </Text>
        <span style={{ opacity: waiting ? 0.5 : 1 }}>
          <VerdictCountList counts={paper.counts} />
        </span>
        <Button
          size="compact-xs"
          data-unprinted
          leftSection={<Icon name="Restore" size={14} />}
          disabled={changed.length === 0}
          onClick={() => onChoose(withoutChoices(choices, readings))}
        >
          {changed.length === 0
            ? `All as in the ${set?.title.toLowerCase() ?? "named"} set`
            : `Reset ${count(changed.length, "switch", "switches")}`}
        </Button>
      </Group>
      <Columns least="20rem">
        {readings.map((reading) => (
          <Switch
            key={reading.id}
            {...{ reading, set }}
            onChange={(choice) => onChoose(withChoice(choices, reading.id, choice, standardOf(reading, set)))}
          />
        ))}
      </Columns>
    </>
  );
}

function choiceOf(
  { id, choices: offered, chosen }: PaperReading,
  choices: Choices,
  set: PaperInterpretation | undefined,
): string {
  const requested = choices[id] ?? set?.choices[id];
  return offered.find((choice) => choice.id === requested)?.id ?? chosen;
}

interface SwitchProps {
  readonly reading: PaperReading;
  readonly set: PaperInterpretation | undefined;
  readonly onChange: (choice: string) => void;
}

function Switch({ reading, set, onChange }: SwitchProps) {
  const id = useId();
  const standard = reading.choices.find((choice) => choice.id === standardOf(reading, set));
  const current = reading.choices.find((choice) => choice.id === reading.chosen);
  const isChanged = standard !== current;
  return (
    <div className={`${ui.card} ${classes.switch}`} data-changed={isChanged || undefined}>
      <Group gap="0 0.8rem" align="baseline" justify="space-between">
        <Box component="h3" id={id} m={0} fz="sm" fw={650}>
          {typeset(reading.title)}
        </Box>
        {isChanged && standard && (
          <Box component="span" fz="xs" c="var(--accent)">
            {set?.title}: {typeset(standard.label)}
          </Box>
        )}
      </Group>
      <Box component="p" flex={1} m={0} fz="xs" lh="1.4" c="dimmed">
        <Inline text={reading.description} />
      </Box>
      <SegmentedControl
        aria-labelledby={id}
        style={{ alignSelf: "flex-start" }}
        value={reading.chosen}
        data={reading.choices.map((choice) => ({ value: choice.id, label: typeset(choice.label) }))}
        onChange={onChange}
      />
      {current && (
        <Box component="p" m={0} fz="xs" lh="1.4">
          {sourceOf(current.source)}
        </Box>
      )}
    </div>
  );
}

const sourceOf = (source: string) => (source === "ours" ? "Ours." : `${typeset(source)}.`);
