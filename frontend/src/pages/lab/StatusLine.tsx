/** Whether the shown answer was stored or computed, and what it cost. */

import { Text } from "@mantine/core";
import { useLab } from "../../lab/context";
import type { Result } from "../../lab/result";

const ms = (value: number) => `${value < 9.5 ? value.toFixed(1) : value.toFixed(0)} ms`;

function describe({ source, timing }: Result): string {
  const { cached, computed, computeMs, roundTripMs, opened } = timing;
  if (opened) return `Stored result, opened in ${ms(roundTripMs)}`;
  const parts = [
    cached > 0 ? `${cached} from store` : "",
    computed > 0 ? `${computed} computed in ${ms(computeMs)}` : "",
  ];
  return `${source === "live" ? "Live" : "Up to date"}: ${parts.filter(Boolean).join(", ")} · ${ms(roundTripMs)} in all`;
}

/** In the header, or under it where the header has no room. */
export function StatusLine({ position }: { readonly position: "header" | "page" }) {
  const shown = useLab((state) => state.shown);
  const behind = useLab((state) => state.stale && !state.busy);
  return (
    <Text
      size="xs"
      c="dimmed"
      truncate
      flex="0 1 auto"
      miw={0}
      ml="0.3rem"
      {...(position === "header" ? { visibleFrom: "lg" } : { hiddenFrom: "lg", mb: "0.5rem" })}
      data-unprinted
      data-testid={`status-${position}`}
      title={shown ? `Computed by core ${shown.coreVersion}` : ""}
    >
      {shown ? (behind ? "The last result: the form has changed since" : describe(shown)) : "\u00a0"}
    </Text>
  );
}
