import { useComputedColorScheme } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useMemo } from "react";
import type { Strategy } from "../api/types";
import { printing } from "../lib/printing";
import { strategiesQuery } from "./queries";
import { useStore } from "../lib/store";

/** The same strategies with the colours of light paper, whatever the screen's. */
export function useLightColours(strategies: readonly Strategy[]): readonly Strategy[] {
  const { data } = useQuery(strategiesQuery);
  return useMemo(() => strategies.map((each) => data?.find(({ id }) => id === each.id) ?? each), [strategies, data]);
}

/** The strategies with the colours that stand out on the screen's background; paper is light. */
export function useSchemeColours<List extends readonly Strategy[] | undefined>(strategies: List) {
  const printed = useStore(printing);
  const isDark = useComputedColorScheme("light") === "dark" && !printed;
  return useMemo(
    () => (isDark ? strategies?.map((strategy) => ({ ...strategy, colour: strategy.dark_colour })) : strategies),
    [strategies, isDark],
  );
}
