/** The choice of what changes refer to. */

import type { Strategy } from "../../api/types";
import type { ResultView } from "../../lab/resultView";
import { isRecording } from "../../lib/recording";

/** The strategies that changes can refer to: those that are shown, and others of the result, which say that they are not. */
export function possibleBaselines({
  catalogue,
  ids,
  baseline,
  summaries,
  shown: { source },
}: Pick<ResultView, "catalogue" | "ids" | "baseline" | "summaries" | "shown">): readonly Pick<
  Strategy,
  "id" | "label"
>[] {
  const isToCome = (id: string) => source === "live" && isRecording(id) && !(id in summaries);
  return catalogue
    .filter(({ id }) => id in summaries || id === baseline)
    .map(({ id, label }) => ({
      id,
      label: ids.includes(id) || isToCome(id) ? label : `${label} (${id in summaries ? "hidden" : "failed"})`,
    }));
}
