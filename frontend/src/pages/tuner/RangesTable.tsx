/** What is searched, and from where to where; the rest stays as the scenario has it. */

import { Box, Checkbox, Group } from "@mantine/core";
import type { Scenario } from "../../api/types";
import type { DraftErrors } from "../../features/jobForm/problems";
import type { RangeDraft } from "./draft";
import { ownText, type Tunable, type TunableNumber } from "./space";
import classes from "./tuner.module.css";
import { Entry } from "../../ui/Entry";
import { Fault } from "../../ui/Messages";
import ui from "../../ui/ui.module.css";

interface Props {
  readonly tunable: Tunable;
  /** Its numbers. */
  readonly fields: readonly TunableNumber[];
  readonly scenario: Scenario | undefined;
  readonly ranges: Readonly<Record<string, RangeDraft>>;
  readonly errors: DraftErrors;
  readonly onChange: (name: string, change: Partial<RangeDraft>) => void;
}

export function RangesTable({ tunable, fields, scenario, ranges, errors, onChange }: Props) {
  const rows = [...new Set(fields.map(({ row }) => row))];
  const titles = tunable.triples[0]?.items.map(({ title }) => title) ?? [];
  const wrong = fields.find(({ name }) => errors[`search.${name}`] !== undefined);
  const message = wrong
    ? `${wrong.row}${wrong.single ? "" : `, ${wrong.field.title}`}: ${errors[`search.${wrong.name}`] ?? ""}`
    : errors.search;
  return (
    <>
      <div className={classes.ranges}>
        {titles.length > 0 && <span />}
        {titles.map((title) => (
          <span key={title} className={classes.rangeTitle} aria-hidden>
            {title}
          </span>
        ))}
        {rows.map((row) => (
          <div key={row} className={classes.rangeRow} role="group" aria-label={row}>
            <Box component="span" fz="sm" fw={550}>
              {row}
            </Box>
            {fields
              .filter((each) => each.row === row)
              .map((each) => (
                <Range
                  key={each.name}
                  label={each.single ? row : `${row}, ${each.field.title}`}
                  range={ranges[each.name]}
                  own={scenario ? ownText(scenario, each) : "as it is"}
                  wrong={errors[`search.${each.name}`] !== undefined}
                  title={each.single ? "" : each.field.title}
                  onChange={(change) => onChange(each.name, change)}
                />
              ))}
          </div>
        ))}
      </div>
      {message !== undefined && <Fault>{message}</Fault>}
    </>
  );
}

interface RangeProps {
  readonly label: string;
  /** Stands above it where there is no room for columns. */
  readonly title: string;
  readonly range: RangeDraft | undefined;
  /** The scenario's value. */
  readonly own: string;
  readonly wrong: boolean;
  readonly onChange: (change: Partial<RangeDraft>) => void;
}

function Range({ label, title, range, own, wrong, onChange }: RangeProps) {
  if (!range) return null;
  const end = (key: "from" | "to") => (
    <Entry
      flex="0 1 4.2rem"
      miw="3rem"
      aria-label={`${label}, ${key}`}
      value={range[key]}
      error={wrong}
      onType={(text) => onChange({ [key]: text })}
    />
  );
  return (
    <div className={classes.range}>
      <span className={classes.rangeNarrow} aria-hidden>
        {title}
      </span>
      <Group component="span" gap="0.4rem" wrap="nowrap" mih={30}>
        <Checkbox
          aria-label={`Tune ${label}`}
          checked={range.on}
          onChange={(event) => onChange({ on: event.currentTarget.checked })}
        />
        {range.on ? (
          <>
            {end("from")}
            <span className={ui.dim} aria-hidden>
              –
            </span>
            {end("to")}
          </>
        ) : (
          <span className={ui.dim}>stays {own}</span>
        )}
      </Group>
    </div>
  );
}
