/** Reads what `POST /live` answers in binary. */

import type { Failure, LiveAnswer, SeriesByStrategy, Summary } from "./types";

interface LiveHead extends Omit<LiveAnswer, "series" | "strategies"> {
  readonly strategies: Readonly<
    Record<
      string,
      Failure | (Summary & { readonly series: { readonly signals: readonly string[]; readonly samples: number } })
    >
  >;
}

/** The length of its JSON, the JSON, and all numbers in its order. */
export function decodeLive(content: ArrayBuffer): LiveAnswer {
  const length = new DataView(content).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(content, 4, length))) as LiveHead;
  let at = 4 + length;
  const series: Record<string, SeriesByStrategy[string]> = {};
  for (const [strategy, entry] of Object.entries(head.strategies)) {
    if (entry.status === "failed") continue;
    const { signals, samples } = entry.series;
    series[strategy] = Object.fromEntries(
      signals.map((signal, index) => [signal, new Float32Array(content, at + 4 * samples * index, samples)]),
    );
    at += 4 * samples * signals.length;
  }
  return { ...head, series };
}
