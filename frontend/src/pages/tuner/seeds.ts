/** Road seeds as somebody types them: `1-4, 7`. */

export type Seeds =
  | { readonly ok: true; readonly seeds: readonly number[] }
  | { readonly ok: false; readonly message: string };

const MOST = 2 ** 32 - 1;

export function readSeeds(text: string, most: number): Seeds {
  const parts = text.split(/[,;\s]+/).filter((part) => part !== "");
  if (parts.length === 0) return { ok: false, message: "Needs at least one road" };
  const seeds = new Set<number>();
  for (const part of parts) {
    const [, first, last] = /^(\d+)(?:[-–](\d+))?$/.exec(part) ?? [];
    const [from, to] = [Number(first), Number(last ?? first)];
    if (first === undefined || from > MOST || to > MOST)
      return { ok: false, message: `Not a seed: ${part}. Whole numbers and ranges, such as 1-4, 7` };
    if (to < from) return { ok: false, message: `${part} runs backwards` };
    if (to - from >= most) return { ok: false, message: `At most ${most} roads` };
    for (let seed = from; seed <= to; seed += 1) seeds.add(seed);
  }
  return seeds.size > most ? { ok: false, message: `At most ${most} roads` } : { ok: true, seeds: [...seeds] };
}

/** Neighbours as a range: `1-4, 7`. */
export function formatSeeds(seeds: readonly number[]): string {
  const parts: string[] = [];
  for (let start = 0; start < seeds.length;) {
    let end = start;
    while (seeds[end + 1] === (seeds[end] ?? NaN) + 1) end += 1;
    const [first, last] = [String(seeds[start]), String(seeds[end])];
    parts.push(...(end - start >= 2 ? [`${first}-${last}`] : end > start ? [first, last] : [first]));
    start = end + 1;
  }
  return parts.join(", ");
}
