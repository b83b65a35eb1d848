/** How far a job is, and a list of those there are. */

import { Button, Group, Progress, Text, Box, Skeleton, Menu } from "@mantine/core";
import { type ReactNode, useState } from "react";
import { count, formatWhole, formatDuration, formatMinute } from "../units/format";
import { isFinal, useJobCall, type Common, type JobStatus, type JobKind, type JobPath } from "./useJob";
import { compact } from "../ui/IconButton";
import { Icon } from "../ui/icons";
import ui from "../ui/ui.module.css";
import { Fault, Note } from "../ui/Messages";
import { Card } from "../ui/Card";
import { useInfiniteQuery, useMutation, useQueryClient } from "@tanstack/react-query";
import { Link } from "@tanstack/react-router";
import { MoreMenu, NameForm } from "../ui/ListEntry";
import type { Batch, Tuning } from "../api/types";

interface Props<Item extends Common, Job extends Item> extends Pick<JobStatus<Job>, "connected"> {
  readonly kind: JobKind<Item, Job>;
  readonly job: Job;
  /** In place of the state's own words. */
  readonly texts?: Partial<Record<Common["state"], string>>;
  readonly counts: ReactNode;
  /** Seconds, `null` while unknown. */
  readonly left: number | null;
  /** Continues one that has ended. */
  readonly resume?: ReactNode;
  readonly readOnly?: boolean;
  /** What it is about. */
  readonly children: ReactNode;
}

const STATE: Readonly<Record<Common["state"], string>> = {
  planning: "Planning…",
  queued: "Waiting for its turn",
  running: "Running",
  done: "Done",
  cancelled: "Cancelled; finished runs are kept",
  failed: "Failed",
};

/** To the form that starts another one. */
export const NewJob = ({ to, label }: { readonly to: "/tuner" | "/robustness"; readonly label: string }) => (
  <Button
    aria-label={label}
    classNames={compact}
    leftSection={<Icon name="Plus" size={15} />}
    renderRoot={(props) => <Link to={to} {...props} />}
  >
    {label}
  </Button>
);

const waitsFor = ({ position }: Pick<Common, "position">) => `${count(position, "run")} before it`;

export function JobState<Item extends Common, Job extends Item>({
  kind,
  job,
  texts,
  counts,
  left,
  resume,
  connected,
  readOnly = false,
  children,
}: Props<Item, Job>) {
  const cancel = useJobCall(kind, job.id, () => kind.calls.cancel(job.id));
  const { done, failed, total } = kind.counts(job);
  const ended = isFinal(job);
  return (
    <Card className={ui.part} aria-label="Progress" data-state={job.state}>
      <Group gap="0.3rem 0.9rem" mih={30}>
        <Text fw={650} role="status" data-testid={`${kind.name}-state`}>
          {texts?.[job.state] ?? STATE[job.state]}
          {job.state === "queued" && job.position > 0 && `, ${waitsFor(job)}`}
          {job.reason !== null && `: ${job.reason}`}
        </Text>
        <Text flex="1 1 12rem" c="dimmed" data-testid={`${kind.name}-counts`}>
          {counts}
          {left !== null && !ended && ` · about ${formatDuration(left)} left`}
        </Text>
        {readOnly ? null : ended ? (
          resume
        ) : (
          <Button loading={cancel.isPending} onClick={() => cancel.mutate(undefined)}>
            Cancel
          </Button>
        )}
      </Group>
      <Progress.Root size={8} transitionDuration={200}>
        <Progress.Section
          value={total === 0 ? 0 : (100 * (done + failed)) / total}
          color={job.state === "failed" ? "red" : job.state === "cancelled" ? "var(--faint)" : "var(--accent)"}
          aria-label={`Finished ${kind.unit}s`}
        />
      </Progress.Root>
      {!connected && !ended && (
        <Note role="status">The connection is interrupted; the numbers are updated when it is back.</Note>
      )}
      {cancel.isError && <Fault>It could not be cancelled: {cancel.error.message}</Fault>}
      {children}
    </Card>
  );
}

/** `1 January, 12:00 · took 3 min · core 0.4.0`. */
export const historyOf = ({ created_at, started_at: started, finished_at: finished, core_version }: Batch | Tuning) =>
  [
    formatMinute(created_at),
    ...(started !== null && finished !== null
      ? [`took ${formatDuration((Date.parse(finished) - Date.parse(started)) / 1000)}`]
      : []),
    `core ${core_version}`,
  ].join(" · ");

interface ListProps<Item extends Common, Job extends Item> {
  readonly kind: JobKind<Item, Job>;
  readonly title: string;
  readonly describe: (item: Item) => Description;
  /** Where there is none. */
  readonly none: string;
  /** The one the page shows. */
  readonly current?: string;
  /** Only those with that name. */
  readonly label?: string;
}

const PAGE = 10;
const REFRESH_MS = 3_000;

export function JobList<Item extends Common, Job extends Item>({
  kind,
  title,
  describe,
  none,
  current,
  label,
}: ListProps<Item, Job>) {
  const { data, error, hasNextPage, isFetchingNextPage, fetchNextPage } = useInfiniteQuery({
    queryKey: [kind.name, "list", label ?? null],
    queryFn: ({ pageParam, signal }) =>
      kind.calls.page({ limit: PAGE, cursor: pageParam, label: label ?? null }, signal),
    initialPageParam: null as string | null,
    getNextPageParam: ({ next }) => next,
    refetchInterval: ({ state }) =>
      state.data?.pages.some(({ items }) => items.some((item) => !isFinal(item))) === true && REFRESH_MS,
  });
  const items = data?.pages.flatMap((page) => page.items);
  return (
    <Card
      aria-label={title}
      aria-busy={!items && !error}
      title={title}
      data-unprinted={current !== undefined || undefined}
    >
      {error && !items ? (
        <Fault size="md" className={ui.note ?? ""}>
          They could not be read: {error.message}
        </Fault>
      ) : !items ? (
        <Skeleton height={44} mx="0.9rem" mb="0.7rem" width="auto" />
      ) : items.length === 0 ? (
        <Text c="dimmed" className={ui.note ?? ""}>
          {none}
        </Text>
      ) : (
        <Box component="ul" className={ui.list ?? ""} p="0 0.5rem 0.3rem">
          {items.map((item) => (
            <JobEntry key={item.id} {...{ kind, item }} description={describe(item)} current={item.id === current} />
          ))}
        </Box>
      )}
      {hasNextPage && (
        <Button
          size="compact-sm"
          variant="subtle"
          m="0 0.5rem 0.5rem"
          loading={isFetchingNextPage}
          onClick={() => void fetchNextPage()}
        >
          Show more
        </Button>
      )}
    </Card>
  );
}

interface Description {
  /** What it is called while it has no name. */
  readonly title: string;
  readonly details: readonly string[];
  /** Where it is shown, if not where its kind is. */
  readonly page?: JobPath;
}

interface JobEntryProps<Item extends Common, Job extends Item> {
  readonly kind: JobKind<Item, Job>;
  readonly item: Item;
  readonly description: Description;
  readonly current: boolean;
}

/** One job of a list. */
function JobEntry<Item extends Common, Job extends Item>({
  kind,
  item,
  description: { title, details, page },
  current,
}: JobEntryProps<Item, Job>) {
  const [openForm, setOpenForm] = useState<"name" | "delete" | null>(null);
  const { done, failed, total } = kind.counts(item);
  const name = item.label ?? title;
  const texts = [
    ...(item.label === null ? [] : [title]),
    ...details,
    formatMinute(item.created_at),
    count(total, kind.unit),
  ];
  return (
    <li className={ui.item} data-state={item.state} aria-current={current || undefined}>
      <Link to={page ?? kind.page} params={{ id: item.id }}>
        <span className={ui.itemTitle}>{name}</span>
        <span className={`${ui.dim} ${item.state === "failed" ? ui.error : ""}`}>
          {[
            (item.state === "queued" ? "waiting" : item.state) +
              (item.state === "done" || total === 0 ? "" : `, ${formatWhole(done + failed)} of ${formatWhole(total)}`),
            ...(item.position > 0 ? [waitsFor(item)] : []),
          ].join(" · ")}
        </span>
        <span className={ui.under}>{texts.join(" · ")}</span>
      </Link>
      <MoreMenu label={`Rename or delete ${name}`}>
        <Menu.Item onClick={() => setOpenForm("name")}>Rename</Menu.Item>
        <Menu.Item disabled={!isFinal(item)} onClick={() => setOpenForm("delete")}>
          {isFinal(item) ? "Delete" : "Delete (cancel it first)"}
        </Menu.Item>
      </MoreMenu>
      {openForm === "name" && <Rename {...{ kind, item }} onClose={() => setOpenForm(null)} />}
      {openForm === "delete" && <Delete {...{ kind, item, name }} onClose={() => setOpenForm(null)} />}
    </li>
  );
}

/** A call that changes the list, and perhaps the job that the page shows. */
function useChange<Item extends Common, Job extends Item, Value = void>(
  { name }: JobKind<Item, Job>,
  call: (value: Value) => Promise<unknown>,
  onClose: () => void,
) {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: call,
    onSuccess: () => {
      onClose();
      return queries.invalidateQueries({ queryKey: [name] });
    },
  });
}

type FormProps<Item extends Common, Job extends Item> = Pick<JobEntryProps<Item, Job>, "kind" | "item"> & {
  readonly onClose: () => void;
};

function Rename<Item extends Common, Job extends Item>({ kind, item, onClose }: FormProps<Item, Job>) {
  const rename = useChange(kind, (name: string) => kind.calls.label(item.id, name.trim() || null), onClose);
  return (
    <NameForm
      name={item.label ?? ""}
      label="Name"
      action="Save"
      longest={200}
      error={rename.error?.message}
      saving={rename.isPending}
      onSave={rename.mutate}
      onClose={onClose}
    />
  );
}

function Delete<Item extends Common, Job extends Item>({
  kind,
  item,
  name,
  onClose,
}: FormProps<Item, Job> & { readonly name: string }) {
  const deletion = useChange(kind, () => kind.calls.delete(item.id), onClose);
  return (
    <Group gap="0.4rem" p="0 0.4rem 0.6rem" role="group" aria-label={`Delete ${name}?`}>
      <Text size="xs" flex={1} {...(deletion.isError && { role: "alert", c: "red" })}>
        {deletion.error?.message ?? "Delete it for good?"}
      </Text>
      <Button variant="filled" color="red" autoFocus loading={deletion.isPending} onClick={() => deletion.mutate()}>
        Delete
      </Button>
      <Button onClick={onClose}>Close</Button>
    </Group>
  );
}
