/** The foot of a form that starts a job: what that takes, a reset, the start. */

import { Box, Button, Group, Text } from "@mantine/core";
import type { ReactNode } from "react";
import type { Draft } from "../../lib/useDraft";
import ui from "../../ui/ui.module.css";
import { formatDuration } from "../../units/dates";
import type { JobFormState } from "./useJobForm";
import { Note } from "../../ui/Messages";

interface Cost {
  /** [s] of one processor core. */
  readonly estimated_cost: number;
  readonly estimated_seconds: number | null;
}

interface Props<Estimate extends Cost> {
  readonly submission: JobFormState<Estimate>;
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
        <ResetDraft isEdited={draft.isEdited} onReset={draft.reset} />
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

/** It stays where there is nothing to reset: a button that went away would take the keyboard's place with it. */
function ResetDraft({ isEdited, onReset }: { readonly isEdited: boolean; readonly onReset: () => void }) {
  return (
    <Button
      size="sm"
      variant="subtle"
      color="gray"
      ml="auto"
      type="button"
      {...(isEdited ? { onClick: onReset } : { "aria-disabled": true, "data-disabled": true })}
    >
      Reset
    </Button>
  );
}
