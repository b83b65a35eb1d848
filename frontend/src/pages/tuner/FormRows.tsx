/** What is minimised, within which limits, and what is searched from where to where. */

import { Group, Box, Checkbox } from "@mantine/core";
import type { Scenario } from "../../api/types";
import { optionsOf, fullName, type Metric } from "../../server/metrics";
import type { DraftErrors } from "../../features/jobForm/jobForm";
import { titleWithUnit } from "../../units/format";
import {
  MOST_OBJECTIVES,
  objectiveOf,
  type ObjectiveKind,
  type ObjectiveDraft,
  limitOf,
  MOST_LIMITS,
  type LimitDraft,
  type RangeDraft,
} from "./draft";
import classes from "./tuner.module.css";
import ui from "../../ui/ui.module.css";
import { Choice, Entry, EntryRow, Finder } from "../../ui/Entry";
import { ownText, useNumericCatalogues, type Tunable, type TunableNumber } from "./space";
import { Fault } from "../../ui/Messages";

interface Props<Drafts> {
  readonly drafts: Drafts;
  readonly errors: DraftErrors;
  readonly onChange: (drafts: Drafts) => void;
}

const WIDTH = { base: "5.6rem", sm: "8.2rem" };

const SUMS: readonly { readonly value: ObjectiveKind; readonly label: string; readonly text: string }[] = [
  {
    value: "paper",
    label: "The paper’s sum (Eq. 16): RMS",
    text: "q1·(a/aₚ)² + q2·(r/rₚ)² + q3·(F/Fₚ)², RMS over the passive car’s",
  },
  {
    value: "peaks",
    label: "The same sum of peaks",
    text: "q1·(a/aₚ)² + q2·(r/rₚ)² + q3·(F/Fₚ)², peaks over the passive car’s",
  },
];
const Q = ["q1, body", "q2, pitch", "q3, tyres"] as const;

export function ObjectiveRows({ drafts: objectives, errors, onChange }: Props<readonly ObjectiveDraft[]>) {
  const { figures, catalogue } = useNumericCatalogues();
  const patch = (key: number, change: Partial<ObjectiveDraft>) =>
    onChange(objectives.map((each) => (each.key === key ? { ...each, ...change } : each)));
  const add = (value: string) => {
    const key = 1 + Math.max(-1, ...objectives.map((each) => each.key));
    const kind = SUMS.find((sum) => sum.value === value)?.value;
    onChange([...objectives, kind ? objectiveOf(key, kind) : objectiveOf(key, "figure", value)]);
  };
  const usedFigures = objectives.map(({ figure }) => figure);
  return (
    <div className={ui.stack}>
      {objectives.map((objective, index) => {
        const { key, kind, q, window, figure: name } = objective;
        const figure = figures.find((each) => each.key === name);
        const sum = SUMS.find(({ value }) => value === kind);
        const error = errors[`objectives.${index}`];
        return (
          <EntryRow
            key={key}
            title={sum?.label ?? (figure ? fullName(figure) : (name ?? ""))}
            error={error}
            onRemove={() => onChange(objectives.filter((each) => each.key !== key))}
            beside={
              <span className={ui.dim}>
                {sum ? sum.text : titleWithUnit("mean over the roads", figure?.unit ?? "1")}
              </span>
            }
          >
            {sum && (
              <Group gap="0.4rem 0.7rem" align="flex-end" mt="0.3rem">
                {Q.map((label, part) => (
                  <Entry
                    key={label}
                    w={WIDTH}
                    label={label}
                    value={q[part] ?? ""}
                    onType={(typed) => {
                      const [q1, q2, q3] = q.map((text, at) => (at === part ? typed : text));
                      patch(key, { q: [q1 ?? "", q2 ?? "", q3 ?? ""] });
                    }}
                  />
                ))}
                <Choice
                  label="Over"
                  value={window}
                  data={catalogue.windows.map((each) => ({ value: each.key, label: each.label }))}
                  onPick={(next) => patch(key, { window: next })}
                />
              </Group>
            )}
          </EntryRow>
        );
      })}
      {objectives.length < MOST_OBJECTIVES && (
        <FigureSelect
          label={
            objectives.length === 0 ? "Add an objective" : "Add another objective: the answer is then a Pareto front"
          }
          figures={figures.filter(({ key }) => !usedFigures.includes(key))}
          first={SUMS}
          error={errors.objectives}
          onPick={add}
        />
      )}
    </div>
  );
}

interface FigureSelectProps {
  readonly label: string;
  readonly figures: readonly Metric[];
  /** What stands before the figures. */
  readonly first?: readonly { readonly value: string; readonly label: string }[];
  readonly error?: string | undefined;
  readonly onPick: (key: string) => void;
}

/** Finds a metric of a run by its name. */
function FigureSelect({ figures, first = [], ...props }: FigureSelectProps) {
  const data = [
    ...(first.length > 0 ? [{ group: "Sums over the passive car’s", items: [...first] }] : []),
    ...optionsOf(figures),
  ];
  return (
    <Finder
      maw="32rem"
      placeholder="Name of a metric…"
      nothingFoundMessage="No metric of that name"
      data={data}
      {...props}
    />
  );
}

/** What may not be exceeded on any training road. */
export function LimitRows({ drafts: limits, errors, onChange }: Props<readonly LimitDraft[]>) {
  const { figures } = useNumericCatalogues();
  return (
    <div className={ui.stack}>
      {limits.map(({ figure: name, atMost }, index) => {
        const figure = figures.find(({ key }) => key === name);
        const title = figure ? fullName(figure) : name;
        const error = errors[`limits.${index}`];
        return (
          <EntryRow
            key={name}
            title={title}
            name={`Limit: ${title}`}
            removal={`the limit of ${title}`}
            error={error}
            onRemove={() => onChange(limits.filter((each) => each.figure !== name))}
            beside={
              <>
                <span className={ui.dim}>at most</span>
                <Entry
                  w={WIDTH}
                  aria-label={`${title}, at most`}
                  value={atMost}
                  unit={figure?.unit}
                  error={error !== undefined}
                  onType={(text) =>
                    onChange(limits.map((each) => (each.figure === name ? { ...each, atMost: text } : each)))
                  }
                />
              </>
            }
          />
        );
      })}
      {limits.length < MOST_LIMITS && (
        <FigureSelect
          label="Add a limit"
          figures={figures.filter(({ key }) => !limits.some(({ figure }) => figure === key))}
          error={errors.limits}
          onPick={(key) => onChange([...limits, limitOf(key)])}
        />
      )}
    </div>
  );
}

interface RangesProps extends Props<Readonly<Record<string, RangeDraft>>> {
  readonly tunable: Tunable;
  /** Its numbers. */
  readonly fields: readonly TunableNumber[];
  readonly scenario: Scenario | undefined;
}

const isWrong = (errors: DraftErrors, { name }: TunableNumber) => errors[`search.${name}`] !== undefined;
const labelOf = ({ row, single, field }: TunableNumber) => (single ? row : `${row}, ${field.title}`);

export function RangesTable({ tunable, fields, scenario, drafts, errors, onChange }: RangesProps) {
  const rows = [...new Set(fields.map(({ row }) => row))];
  const titles = tunable.triples[0]?.items.map(({ title }) => title) ?? [];
  const wrong = fields.find((each) => isWrong(errors, each));
  const message = wrong ? `${labelOf(wrong)}: ${errors[`search.${wrong.name}`] ?? ""}` : errors.search;
  return (
    <>
      <div className={classes.ranges}>
        {titles.length > 0 && <span />}
        {titles.map((title) => (
          <Box component="span" key={title} fz="xs" c="dimmed" visibleFrom="sm" aria-hidden>
            {title}
          </Box>
        ))}
        {rows.map((row) => (
          <div key={row} className={classes.rangeRow} role="group" aria-label={row}>
            <Box component="span" fz="sm" fw={550}>
              {row}
            </Box>
            {fields
              .filter((each) => each.row === row)
              .map((each) => {
                const range = drafts[each.name];
                return (
                  range && (
                    <Range
                      key={each.name}
                      {...{ range, each, scenario }}
                      wrong={isWrong(errors, each)}
                      onChange={(change) => onChange({ ...drafts, [each.name]: { ...range, ...change } })}
                    />
                  )
                );
              })}
          </div>
        ))}
      </div>
      {message !== undefined && <Fault>{message}</Fault>}
    </>
  );
}

interface RangeProps extends Pick<RangesProps, "scenario"> {
  readonly each: TunableNumber;
  readonly range: RangeDraft;
  readonly wrong: boolean;
  readonly onChange: (change: Partial<RangeDraft>) => void;
}

function Range({ each, range, scenario, wrong, onChange }: RangeProps) {
  const label = labelOf(each);
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
    <Group gap="0.4rem" wrap="nowrap" mih={30} {...(!each.single && { w: { base: "100%", sm: "auto" } })}>
      {!each.single && (
        <Box component="span" flex={1} fz="xs" c="dimmed" hiddenFrom="sm" aria-hidden>
          {each.field.title}
        </Box>
      )}
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
        <span className={ui.dim}>stays {scenario ? ownText(scenario, each) : "as it is"}</span>
      )}
    </Group>
  );
}
