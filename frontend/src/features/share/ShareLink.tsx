/** One click makes a link, copies it and shows it; where copying is refused, the address stands there to be copied. */

import { Button, Popover, Text, ActionIcon, Stack, TextInput, Anchor, Group } from "@mantine/core";
import { useRef, useState, useEffect } from "react";
import { Icon } from "../../ui/icons";
import { explain } from "../../api/problem";
import { type NewLink } from "../../api/types";
import { copyWhenThere, useCopied } from "../../ui/useCopied";
import { useAction, useActionButton } from "../../lab/actions";
import { Note, Fault } from "../../ui/Messages";
import { compact } from "../../ui/IconButton";
import { useMutation, useQuery, useQueryClient } from "@tanstack/react-query";
import { ask } from "../../api/http";
import { formatMinute } from "../../units/format";

type Outcome =
  | { readonly kind: "making" }
  | { readonly kind: "created"; readonly url: string; readonly copied: boolean }
  | { readonly kind: "failed"; readonly message: string };

interface Props {
  /** Makes the link. */
  readonly make: () => Promise<Pick<NewLink, "url">>;
  /** Why there is nothing to share, `null` where there is. */
  readonly obstacle: string | null;
  /** What the link opens, in a sentence. */
  readonly opens: string;
  /** Whether it makes links that one can take back. */
  readonly mine?: boolean;
}

export function ShareLink({ make, obstacle, opens, mine = true }: Props) {
  const [outcome, setOutcome] = useState<Outcome | null>(null);
  const newest = useRef(0);
  const opened = outcome !== null && outcome.kind !== "making";

  const share = () => {
    const turn = ++newest.current;
    const land = (next: Outcome) => {
      if (turn === newest.current) setOutcome(next);
    };
    land({ kind: "making" });
    const address = make().then(({ url }) => new URL(url, window.location.origin).href);
    const copied = copyWhenThere(address);
    address
      .then(async (url) => land({ kind: "created", url, copied: await copied }))
      .catch((error: unknown) => land({ kind: "failed", message: reasonOf(error) }));
  };

  useAction("share", obstacle === null ? share : null);
  const { label, onClick } = useActionButton("share");

  return (
    <Popover
      opened={opened}
      onDismiss={() => setOutcome(null)}
      position="bottom-end"
      width={430}
      shadow="md"
      trapFocus
      returnFocus
      withRoles={false}
    >
      <Popover.Target>
        <Button
          data-hint={opened ? undefined : (obstacle ?? "Makes a link that opens exactly this")}
          variant="light"
          aria-label={label}
          classNames={compact}
          leftSection={<Icon name="Link" size={15} />}
          loading={outcome?.kind === "making"}
          {...(obstacle === null ? {} : { "data-disabled": true })}
          aria-disabled={obstacle !== null}
          {...(obstacle === null ? {} : { "aria-description": obstacle })}
          onClick={onClick}
        >
          {label}
        </Button>
      </Popover.Target>
      <Popover.Dropdown role="dialog" aria-label="Share" maw="calc(100vw - 1rem)">
        <Stack gap="0.5rem">
          {outcome?.kind === "created" && (
            <>
              <Text fw={600} role="status">
                {outcome.copied ? "Link copied" : "Here is the link: select and copy it"}
              </Text>
              <LinkField url={outcome.url} />
              <Note>{opens}</Note>
              {mine && <MyLinks />}
            </>
          )}
          {outcome?.kind === "failed" && (
            <>
              <Text fw={600} role="alert">
                No link could be created: {outcome.message}
              </Text>
              <Button onClick={share}>Try again</Button>
            </>
          )}
        </Stack>
      </Popover.Dropdown>
    </Popover>
  );
}

const reasonOf = (error: unknown) => (error instanceof Error ? explain(error) : "something went wrong");

/** An address to be read, selected and copied. */
function LinkField({ url }: { readonly url: string }) {
  const input = useRef<HTMLInputElement>(null);
  const { copied, copy } = useCopied();
  useEffect(() => {
    input.current?.focus();
    input.current?.setSelectionRange(0, url.length, "backward"); // so that its beginning is in sight
  }, [url]);
  return (
    <TextInput
      ref={input}
      readOnly
      data-autofocus
      aria-label="Address of the link"
      value={url}
      onFocus={(event) => event.currentTarget.select()}
      rightSection={
        <ActionIcon
          data-hint={copied ? "Copied" : "Copy"}
          size={24}
          variant="subtle"
          aria-label={copied ? "Copied" : "Copy the address"}
          onClick={() => copy(url)}
        >
          {copied ? <Icon name="Check" size={15} /> : <Icon name="Copy" size={15} />}
        </ActionIcon>
      }
    />
  );
}

interface ShareAddressProps {
  /** What is shown, such as `study`. */
  readonly what: string;
  readonly ready: boolean;
  /** By default the page's own. */
  readonly path?: string;
}

/** Shares a page that an address says all of. */
export function ShareAddress({ what, ready, path }: ShareAddressProps) {
  return (
    <ShareLink
      make={() => Promise.resolve({ url: path ?? window.location.href })}
      obstacle={ready ? null : `There is no ${what} to share yet`}
      opens={`It opens this ${what}, for anyone who reaches this server.`}
      mine={false}
    />
  );
}

/** The newest links that one has made, each to be taken back; nothing where the service does not tell whose they are. */
const SHOWN = 5;
const QUERY = ["my-links"];

export function MyLinks() {
  const queries = useQueryClient();
  const { data } = useQuery({
    queryKey: QUERY,
    queryFn: ({ signal }) => ask("get", "/links", { query: { limit: 50 } }, signal),
    retry: false,
    staleTime: 0,
  });
  const revoke = useMutation({
    mutationFn: (slug: string) => ask("delete", "/links/{slug}", { path: { slug } }),
    onSuccess: () => queries.invalidateQueries({ queryKey: QUERY }),
  });
  const links = (data?.links ?? []).filter((link) => link.revoked_at === null).slice(0, SHOWN);
  if (links.length === 0) return null;
  return (
    <Stack gap="0.2rem" role="group" aria-label="My links">
      <Text fw={600}>My links</Text>
      {links.map(({ slug, url, kind, created_at }) => (
        <Group key={slug} justify="space-between" wrap="nowrap">
          <Anchor href={url} size="xs">
            {kind === "run" ? "Result" : "Sweep"}, {formatMinute(created_at)}
          </Anchor>
          <Button
            size="compact-xs"
            variant="subtle"
            aria-label={`Take back the link of ${formatMinute(created_at)}`}
            data-hint="It opens nothing any more, for anybody"
            loading={revoke.isPending && revoke.variables === slug}
            onClick={() => revoke.mutate(slug)}
          >
            Take back
          </Button>
        </Group>
      ))}
      {revoke.isError && <Fault>{revoke.error.message}</Fault>}
    </Stack>
  );
}
