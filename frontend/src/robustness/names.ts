/** Short names of the fields a study varies, where there is no room for their titles. */

import type { Batch } from "../api/types";

const NAMES: Readonly<Record<string, string>> = {
  "mismatch.body_mass": "body mass",
  "mismatch.springs": "springs",
  "mismatch.damping": "damping",
  "mismatch.tyres": "tyres",
  "mismatch.preview_offset": "preview offset",
  "mismatch.preview_gain": "preview gain",
  "mismatch.preview_noise": "preview noise",
  "mismatch.preview_delay": "preview delay",
  "actuator.bandwidth": "actuator bandwidth",
  "actuator.saturation": "saturation",
  "road.seed": "road",
};

/** Any other field by its title where it is known, else by the end of its dotted name. */
export const nameOf = (field: string, fields: Batch["fields"] = []): string =>
  NAMES[field] ?? fields.find(({ name }) => name === field)?.title ?? field.replace(/^.*\./, "").replace(/_/g, " ");
