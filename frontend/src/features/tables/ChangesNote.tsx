/** What a change without an arrow says. */

import { Box } from "@mantine/core";
import { getAt } from "../../scenario/path";
import { whyNotCompared } from "../../lab/compare";
import type { Scene } from "../../lab/resultView";

function textOf({ shown, against }: Scene): string {
  const { over, scenario } = shown;
  const isMeasured = typeof getAt(scenario, "/road/profile") === "string"; // then there is no other road like it
  if (over === null)
    return `One road: a change without an arrow is zero or within one road’s luck${isMeasured ? "" : "; choose several roads"}.`;
  const isPaired = against === null || whyNotCompared(shown, against.shown) === null;
  return isPaired
    ? "Changes are paired by road, with their 95 % interval; one whose interval includes zero has no arrow."
    : "\u00a0";
}

export function ChangesNote({ scene }: { readonly scene: Scene }) {
  return (
    <Box component="p" m={0} p="0.3rem 0.9rem 0" fz="0.71875rem" c="dimmed" data-testid="changes-note">
      {textOf(scene)}
    </Box>
  );
}
