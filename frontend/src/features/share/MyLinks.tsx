/** The newest links that one has made, each to be taken back; nothing where the service does not tell whose they are. */

import { Anchor, Button, Group, Stack, Text } from "@mantine/core";
import { useMutation, useQuery, useQueryClient } from "@tanstack/react-query";
import { ask } from "../../api/http";
import { Fault } from "../../ui/Messages";
import { formatMinute } from "../../units/dates";

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
