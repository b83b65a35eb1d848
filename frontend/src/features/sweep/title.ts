import type { Batch } from "../../api/types";
import { axesOf } from "./axes";

/** What a sweep is called by the fields it changes. */
export const titleOf = (fields: Batch["fields"]) =>
  axesOf(fields)
    .map(({ title }) => title)
    .join(" × ") || "The scenario alone";
