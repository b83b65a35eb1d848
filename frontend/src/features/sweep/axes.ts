/** The fields of a sweep as axes. */

import type { Batch } from "../../api/types";

export interface AxisOf {
  readonly name: string;
  readonly title: string;
  readonly unit: string;
}

/** The fields that are swept by themselves, each named with those that take its value. */
export function axesOf(fields: Batch["fields"]): readonly AxisOf[] {
  return fields
    .filter(({ linked_to: leader }) => leader === null)
    .map(({ name, title, unit }) => ({
      name,
      unit,
      title: [title, ...fields.filter((each) => each.linked_to === name).map((each) => each.title.toLowerCase())].join(
        " = ",
      ),
    }));
}
