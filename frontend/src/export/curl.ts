/** The current run as a command line. */

import type { Scenario, StrategyId } from "../api/types";

/** Safe inside single quotes of a POSIX shell. */
function quoted(text: string): string {
  return `'${text.replace(/'/g, `'\\''`)}'`;
}

export function curlCommand(origin: string, scenario: Scenario, strategies: readonly StrategyId[]): string {
  const body = JSON.stringify({ scenario, strategies });
  return `curl -sS ${origin}/api/v1/runs -H 'content-type: application/json' -d ${quoted(body)}`;
}
