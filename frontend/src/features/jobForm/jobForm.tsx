/** A form that starts a job: what its texts say, what that takes, where errors belong, and its foot. */

import { Box, Button, Group, Text } from "@mantine/core";
import { type ReactNode, useRef } from "react";
import type { Draft } from "../../lib/useDraft";
import ui from "../../ui/ui.module.css";
import { formatDuration, parseInput } from "../../units/format";
import { NO_RANGE, parseTyped } from "../../scenario/limits";
import type { NumberField } from "../../scenario/schema";
import { Note } from "../../ui/Messages";
import { useDebouncedValue } from "@mantine/hooks";
import { useMutation, useQuery } from "@tanstack/react-query";
import { useRouter, type NavigateOptions } from "@tanstack/react-router";
import { ApiProblem, type FieldError } from "../../api/problem";
import { navigateIfStillHere } from "../../ui/openInLab";

interface Cost {
  /** [s] of one processor core. */
  readonly estimated_cost: number;
  readonly estimated_seconds: number | null;
}

interface Props<Estimate extends Cost> {
  readonly submission: ReturnType<typeof useJobForm<never, never, Estimate>>;
  readonly draft: Pick<Draft<unknown>, "isEdited" | "reset">;
  /** How much it is, such as `12 runs`. */
  readonly amount: (estimate: Estimate) => string;
  readonly notes?: (estimate: Estimate) => readonly string[];
  /** The form around it starts the job when it is submitted. */
  readonly inForm?: boolean;
  /** Further buttons. */
  readonly children?: ReactNode;
}

const time = ({ estimated_seconds: seconds, estimated_cost: cost }: Cost) =>
  seconds === null ? `about ${formatDuration(cost)} of one processor core` : `about ${formatDuration(seconds)}`;

export function StartFoot<Estimate extends Cost>({
  submission: { estimate, pending, errors, general, starting, start },
  draft,
  amount,
  notes,
  inForm = false,
  children,
}: Props<Estimate>) {
  const wrong = [...new Set([...general, ...Object.values(errors)])];
  const otherwise = wrong.length > 0 ? `It cannot start: ${wrong.join(". ")}` : pending ? "Estimating…" : "\u00a0";
  return (
    <div className={ui.foot}>
      <Box flex="1 1 9rem" mih="1.4rem" role="status" data-testid="estimate">
        <Text {...(estimate ? { fw: 600 } : { c: "dimmed" })}>
          {estimate ? `${amount(estimate)}, ${time(estimate)}` : otherwise}
        </Text>
        {estimate && notes?.(estimate).map((note) => <Note key={note}>{note}.</Note>)}
      </Box>
      <Group gap="xs" wrap="nowrap" ml="auto">
        {/* It stays where there is nothing to reset: a button that went away would take the keyboard's place with it. */}
        <Button
          size="sm"
          variant="subtle"
          color="gray"
          ml="auto"
          type="button"
          {...(draft.isEdited ? { onClick: draft.reset } : { "aria-disabled": true, "data-disabled": true })}
        >
          Reset
        </Button>
        {children}
        <Button
          size="sm"
          variant="filled"
          disabled={estimate === undefined}
          loading={starting}
          {...(inForm ? { type: "submit" } : { onClick: start })}
        >
          Start
        </Button>
      </Group>
    </div>
  );
}

const REST_MS = 350;

interface JobFormOptions<Read, Body, Estimate> {
  readonly kind: string;
  /** What the form itself says. */
  readonly parsed: Parsed<Read>;
  /** What it asks for; null while there is nothing to ask for yet. */
  readonly bodyOf: (read: Read) => Body | null;
  readonly fieldNameOf: FieldNameOf;
  readonly estimate: (body: Body, signal: AbortSignal) => Promise<Estimate>;
  /** Begins it and says where it can be seen. What is sent carries its `keyOf`. */
  readonly submit: (body: Body, keyOf: (sent: unknown) => string) => Promise<NavigateOptions>;
  /** Of the form as it was when it was started, also where the reader has gone to another page meanwhile. */
  readonly onSubmitted: () => void;
}

type Started<Body> = { readonly body: Body } & Pick<JobFormOptions<never, Body, unknown>, "onSubmitted">;

/** 128 random bits; `crypto.randomUUID` is missing where the page is not a secure context. */
function randomKey(): string {
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}

export function useJobForm<Read, Body, Estimate>(submission: JobFormOptions<Read, Body, Estimate>) {
  const { parsed } = submission;
  const body = parsed.ok ? submission.bodyOf(parsed.body) : null;
  const text = body === null ? "" : JSON.stringify(body);
  const [debouncedText] = useDebouncedValue(text, REST_MS);
  const isUpToDate = debouncedText === text;
  const estimate = useQuery({
    queryKey: ["estimate", submission.kind, debouncedText],
    queryFn: ({ signal }) => submission.estimate(JSON.parse(debouncedText) as Body, signal),
    enabled: debouncedText !== "" && isUpToDate,
    gcTime: 60_000,
  });

  // What is sent again keeps its key, so that a lost answer asked for again does not begin a second one.
  const keys = useRef(new Map<string, string>());
  const keyOf = (sent: unknown) => {
    const name = JSON.stringify(sent);
    const key = keys.current.get(name) ?? randomKey();
    keys.current.set(name, key);
    return key;
  };
  const router = useRouter();
  const started = useMutation({
    mutationFn: (asked: Started<Body>) => submission.submit(asked.body, keyOf),
    onSuccess: (_, { onSubmitted }) => onSubmitted(),
  });

  const problem = started.error ?? (isUpToDate ? estimate.error : null);
  const placed =
    problem instanceof ApiProblem
      ? problemsByField(problem.errors, submission.fieldNameOf, problem.message)
      : { fields: {}, general: problem ? [problem.message] : [] };

  const shown = text && isUpToDate && !estimate.isError ? estimate.data : undefined;
  return {
    errors: parsed.ok ? placed.fields : parsed.errors,
    general: parsed.ok ? placed.general : [],
    estimate: shown,
    pending: text !== "" && (!isUpToDate || estimate.isFetching),
    starting: started.isPending,
    /** Begins it, where an estimate says that it can be and it has not begun. */
    start: () => {
      const { onSubmitted } = submission;
      if (body !== null && shown !== undefined && !started.isPending)
        started.mutate({ body, onSubmitted }, { onSuccess: navigateIfStillHere(router).go });
    },
  };
}

/** By the name a form gives its field. */
export type DraftErrors = Readonly<Record<string, string>>;

interface ProblemsByField {
  readonly fields: DraftErrors;
  /** What belongs to no field of the form. */
  readonly general: readonly string[];
}

/** The form's own name for what a pointer's parts lead to; null where it has no such field. */
export type FieldNameOf = (parts: readonly string[]) => string | null;

const unescape = (part: string) => part.replace(/~1/g, "/").replace(/~0/g, "~");

export function problemsByField(
  errors: readonly FieldError[],
  fieldNameOf: FieldNameOf,
  fallback: string,
): ProblemsByField {
  const fields: Record<string, string> = {};
  const general: string[] = [];
  for (const { pointer, message } of errors) {
    const parts = pointer.split("/").slice(1).map(unescape);
    const name = fieldNameOf(parts);
    if (name !== null) fields[name] ??= message;
    else
      general.push(
        parts[0] === "scenario" && parts.length > 1
          ? `The scenario’s ${parts.slice(1).join(".")}: ${message}`
          : message,
      );
  }
  return { fields, general: errors.length === 0 ? [fallback] : [...new Set(general)] };
}

export type Parsed<Read> =
  | { readonly ok: true; readonly body: Read }
  | { readonly ok: false; readonly errors: DraftErrors };

/** Says what is wrong with a field of the form: what is said first stands. */
export type Put = (field: string, message: string) => void;

/** What is sent, or what has to be changed first. */
export function readForm<Read>(read: (put: Put) => Read): Parsed<Read> {
  const errors: Record<string, string> = {};
  const body = read((field, message) => void (errors[field] ??= message));
  return Object.keys(errors).length > 0 ? { ok: false, errors } : { ok: true, body };
}

const lowerFirst = (text: string) => text.charAt(0).toLowerCase() + text.slice(1);

/** A number of a field as it is typed; NaN where it is none. */
export function readNumber(field: NumberField, text: string, put: (message: string) => void, what: string): number {
  const parsed = parseTyped(field, text);
  if (!parsed.ok) put(`${what}: ${lowerFirst(parsed.message)}`);
  return parsed.ok ? parsed.value : NaN;
}

interface Ends {
  readonly from: string;
  readonly to: string;
}

export function readRange(field: NumberField, { from, to }: Ends, put: (message: string) => void) {
  const ends = [readNumber(field, from, put, "From"), readNumber(field, to, put, "To")] as const;
  if (ends[0] >= ends[1]) put(NO_RANGE);
  return ends;
}

export function readWhole(
  text: string,
  [least, most]: readonly [number, number],
  put: (message: string) => void,
  what: string,
): number {
  const value = parseInput(text) ?? NaN;
  if (!(Number.isInteger(value) && value >= least && value <= most))
    put(`${what}: a whole number from ${least} to ${most}`);
  return value;
}
