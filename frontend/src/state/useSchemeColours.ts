import { useComputedColorScheme } from "@mantine/core";
import { useMemo } from "react";
import type { Strategy } from "../api/types";
import { printing } from "./printing";
import { useStore } from "./store";

/** The strategies with the colours that stand out on the screen's background; paper is light. */
export function useSchemeColours<List extends readonly Strategy[] | undefined>(strategies: List) {
  const printed = useStore(printing);
  const isDark = useComputedColorScheme("light") === "dark" && !printed;
  return useMemo(
    () => (isDark ? strategies?.map((strategy) => ({ ...strategy, colour: strategy.dark_colour })) : strategies),
    [strategies, isDark],
  );
}
