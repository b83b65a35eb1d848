/** What the strategies are held to: a list of limits, each with how the shown result keeps it. */

import { useState, type ReactNode } from "react";
import { Anchor, Group, Box } from "@mantine/core";
import type { Strategy, RequirementResult } from "../../api/types";
import { useLabContext, useReadOnly, useView } from "../../lab/context";
import { valueNamed } from "../../lab/metricPath";
import { limitOf, MOST_REQUIREMENTS, requirementText, type LimitKind, type Requirement } from "../../lab/requirements";
import type { ResultView } from "../../lab/resultView";
import { fullName, optionsOf, type Metric } from "../../server/metrics";
import { useCatalogues } from "../../server/useCatalogues";
import { dialog } from "../../scenario/library";
import { Card } from "../../ui/Card";
import { Choice, Entry, EntryRow, Finder, labelled } from "../../ui/Entry";
import ui from "../../ui/ui.module.css";
import { formatInput, formatResult, prettyUnit } from "../../units/format";
import { parseQuantity } from "../../units/quantity";
import { LIMIT_WORDS, limitText, limitUnit, resultsOf, shownLimit, RESULT_WORDS } from "./judged";
import { Note } from "../../ui/Messages";
import { Icon } from "../../ui/icons";

export function RequirementsCard({ resultView }: { readonly resultView: ResultView }) {
  const { figures } = useCatalogues();
  const { labAddress } = useLabContext();
  const { requirements } = useView();
  const readOnly = useReadOnly();
  const set = (next: readonly Requirement[]) => labAddress.setView({ requirements: next });
  if (readOnly && requirements.length === 0) return null;
  return (
    <Card aria-label="Requirements" title="Requirements" data-unprinted={requirements.length === 0 || undefined}>
      <div className={ui.part}>
        {requirements.map((requirement, index) => (
          <RequirementRow
            key={`${index} ${requirementText(requirement)}`}
            {...{ requirement, resultView, readOnly }}
            figure={figures.find(({ key }) => key === requirement.metric)}
            onChange={(next) => set(requirements.map((each, at) => (at === index ? next : each)))}
            onRemove={() => set(requirements.filter((_, at) => at !== index))}
          />
        ))}
        {!readOnly && requirements.length < MOST_REQUIREMENTS && (
          <div data-unprinted>
            <Finder
              label={requirements.length === 0 ? "Hold a metric to a limit" : "Add a requirement"}
              placeholder="Name of a metric…"
              nothingFoundMessage="No metric of that name"
              maw={420}
              data={optionsOf(figures)}
              onPick={(metric) => set([...requirements, { metric, max: opening(resultView, metric) }])}
            />
          </div>
        )}
        {requirements.length > 0 && (
          <Note>
            {!readOnly && (
              <Anchor component="button" type="button" fz="xs" onClick={() => dialog.set("requirements")}>
                Keep this set
              </Anchor>
            )}{" "}
            {resultView.shown.over === null
              ? "On one road; over several the mean’s 95 % interval has to keep the limit, and one that holds it is uncertain."
              : "Over several roads: uncertain where the mean’s 95 % interval holds the limit."}
          </Note>
        )}
      </div>
    </Card>
  );
}

/** A limit to begin with: what the worst of the strategies has, in two digits. */
function opening({ strategies, summaries, baseline }: ResultView, metric: string): number {
  const values = strategies.flatMap(({ id }) => {
    const value = valueNamed(summaries[id], metric);
    return value !== null && (id !== baseline || strategies.length === 1) ? [value] : [];
  });
  return Number(Math.max(0, ...values).toPrecision(2));
}

interface RowProps {
  readonly requirement: Requirement;
  readonly figure: Metric | undefined;
  readonly resultView: ResultView;
  readonly readOnly: boolean;
  readonly onChange: (next: Requirement) => void;
  readonly onRemove: () => void;
}

const KINDS = (["max", "min", "max_change"] as const).map((value) => ({ value, label: LIMIT_WORDS[value] }));
const OTHERS = "";

function RequirementRow({ requirement, figure, resultView, readOnly, onChange, onRemove }: RowProps) {
  const title = figure ? fullName(figure) : requirement.metric;
  const { kind, value } = limitOf(requirement);
  const results = resultsOf(requirement, resultView.judged[resultView.shown.runId ?? ""] ?? []);
  const labelOf = (id: string) => resultView.catalogue.find((strategy) => strategy.id === id)?.label ?? id;
  const unit = limitUnit(kind, figure);
  const { metric, strategies } = requirement;
  const who = strategies ? { strategies } : {};
  return (
    <EntryRow
      title={title}
      name={`Requirement: ${title} ${limitText(requirement, figure)}`}
      removal={`the requirement of ${title}`}
      error={undefined}
      {...(readOnly ? {} : { onRemove })}
      beside={
        readOnly ? (
          <span className={ui.dim}>{limitText(requirement, figure)}</span>
        ) : (
          <>
            <Choice
              aria-label={`${title}: kind of limit`}
              value={kind}
              data={KINDS}
              onPick={(next) => onChange({ metric, [next as LimitKind]: next === "max_change" ? 0 : value, ...who })}
            />
            <LimitEntry
              label={`${title}, ${LIMIT_WORDS[kind]}`}
              unit={unit}
              value={shownLimit(kind, value, figure)}
              onSet={(shown) => {
                const si = kind === "max_change" ? shown : shown / (figure?.scale ?? 1);
                onChange({ metric, [kind]: Number(si.toPrecision(12)), ...who });
              }}
            />
            <Choice
              aria-label={`${title}: of which strategies`}
              value={strategies?.join(",") ?? OTHERS}
              data={whose(resultView.strategies, requirement, kind, resultView.baseline)}
              onPick={(ids) =>
                onChange({ metric, [kind]: value, ...(ids !== OTHERS && { strategies: ids.split(",") }) })
              }
            />
          </>
        )
      }
    >
      <Group component="ul" className={ui.list ?? ""} gap="0.15rem 0.9rem" fz="sm" aria-label={`${title}: results`}>
        {results.map((result) => (
          <li key={result.strategy}>
            {labelOf(result.strategy)}{" "}
            {result.value === null
              ? (result.reason ?? "")
              : `${formatResult(shownLimit(kind, result.value, figure))} ${prettyUnit(unit)}`}{" "}
            <RequirementMark result={result} />
          </li>
        ))}
      </Group>
    </EntryRow>
  );
}

/** Who may be asked to keep it: all but the baseline, or one; and whoever an address names. */
function whose(
  strategies: readonly Strategy[],
  { strategies: named }: Requirement,
  kind: LimitKind,
  base: string | null,
) {
  const single = strategies.filter(({ id }) => kind !== "max_change" || id !== base);
  const several = named && named.length > 1 ? [{ value: named.join(","), label: named.join(", ") }] : [];
  const missing = named?.length === 1 && single.every(({ id }) => id !== named[0]) ? named : [];
  return [
    { value: OTHERS, label: "all but the baseline" },
    ...several,
    ...labelled(single),
    ...missing.map((id) => ({ value: id, label: id })),
  ];
}

interface LimitEntryProps {
  readonly label: string;
  readonly unit: string;
  /** In that unit. */
  readonly value: number;
  readonly onSet: (value: number) => void;
}

/** A limit as somebody types it, taken once it is a number. */
function LimitEntry({ label, unit, value, onSet }: LimitEntryProps) {
  const [typed, setTyped] = useState<string | null>(null);
  const parsed = typed === null ? null : parseQuantity(typed, unit);
  const finish = () => {
    if (!parsed?.ok) return;
    setTyped(null);
    onSet(parsed.value);
  };
  return (
    <Entry
      w="7.5rem"
      aria-label={label}
      unit={unit}
      value={typed ?? formatInput(value)}
      error={parsed && !parsed.ok ? parsed.message : undefined}
      onType={setTyped}
      onBlur={finish}
      onKeyDown={(event) => {
        if (event.key === "Enter") finish();
        if (event.key !== "Escape" || typed === null) return;
        event.preventDefault(); // it closes nothing else
        setTyped(null);
      }}
    />
  );
}

const SIGNS = { pass: "Check", fail: "X", uncertain: "AlertTriangle" } as const;

/** Whether a number keeps what is required of it: a word and a sign, colour only repeats them. */
export function RequirementMarks({ results }: { readonly results: readonly RequirementResult[] }) {
  if (results.length === 0) return null;
  return results.map((result, index) => <RequirementMark key={index} result={result} />);
}

function RequirementMark({ result }: { readonly result: RequirementResult }) {
  const figure = useCatalogues().figures.find(({ key }) => key === result.metric);
  const limit = limitText(result, figure, result.baseline);
  return (
    <ResultMark result={result.result} title={`Required: ${limit}`}>
      <span className="visually-hidden">, required {limit}</span>
    </ResultMark>
  );
}

interface MarkProps {
  readonly result: RequirementResult["result"];
  readonly title?: string;
  readonly children?: ReactNode;
}

export function ResultMark({ result, title, children }: MarkProps) {
  return (
    <Box component="span" className={ui.mark ?? ""} mr="0.35rem" fz="xs" data-result={result} title={title}>
      <Icon name={SIGNS[result]} size={12} stroke={2.4} /> {RESULT_WORDS[result]}
      {children}
    </Box>
  );
}
