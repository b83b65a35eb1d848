/** The jobs of a kind there are, the newest first: opened, renamed, deleted. */

import { Button, Skeleton, Text } from "@mantine/core";
import { useInfiniteQuery } from "@tanstack/react-query";
import { isFinal } from "./follow";
import { JobEntry, type Description } from "./JobEntry";
import classes from "./jobs.module.css";
import type { Common, Kind } from "./useJob";
import { Fault } from "../ui/Fault";
import ui from "../ui/ui.module.css";
import { Card } from "../ui/Card";

interface Props<Item extends Common, Job extends Item> {
  readonly kind: Kind<Item, Job>;
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
}: Props<Item, Job>) {
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
    <Card aria-label={title} aria-busy={!items && !error} title={title}>
      {error && !items ? (
        <Fault size="sm" className={ui.note ?? ""}>
          They could not be read: {error.message}
        </Fault>
      ) : !items ? (
        <Skeleton height={44} mx="0.9rem" mb="0.7rem" width="auto" />
      ) : items.length === 0 ? (
        <Text size="sm" c="dimmed" className={ui.note ?? ""}>
          {none}
        </Text>
      ) : (
        <ul className={classes.list}>
          {items.map((item) => (
            <JobEntry key={item.id} {...{ kind, item }} description={describe(item)} current={item.id === current} />
          ))}
        </ul>
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
