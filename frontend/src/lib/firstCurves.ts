/** What the first view needs comes first: code for all else is fetched once the first curves stand. */

/** Nor is it waited for longer than this where there are none [ms]. */
const LATEST_MS = 1500;

let resolve: () => void;
export const firstCurves = new Promise<void>((resolved) => {
  resolve = resolved;
});

/** Curves are drawn, or none are to come. */
export const endFirstView = () => resolve();

globalThis.setTimeout(endFirstView, LATEST_MS);
