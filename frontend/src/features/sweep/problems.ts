/** Where the server's errors about a sweep belong. */

import type { FieldNameOf } from "../jobForm/problems";

export const sweepFieldName =
  (names: readonly string[]): FieldNameOf =>
  ([root, form, ...rest]) => {
    if (root === "strategies") return "strategies";
    if (root !== "sweep") return null;
    const name = form === "grid" ? rest[0] : rest[0] === "ranges" ? rest[1] : rest[0];
    return name !== undefined && (names.includes(name) || name === "samples" || name === "seed") ? name : null;
  };
