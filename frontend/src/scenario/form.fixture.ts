/** A small schema of the scenario's make, for tests. */

import type { JsonObject } from "../api/types";
import { readSchema } from "./schema";

const weight = { type: "number", minimum: 0, maximum: 1000 };

const SCHEMA: JsonObject = {
  $defs: {
    Bump: {
      type: "object",
      description: "The obstacle.",
      properties: {
        shape: { type: "string", enum: ["cosine", "flat_top"], default: "cosine", title: "Shape" },
        height: {
          type: "number",
          minimum: -1,
          maximum: 1,
          default: 0.1,
          title: "Height",
          search_words: ["hump", "pothole", "speed bump"],
          unit: "m",
          shown_unit: "cm",
          soft_range: [-0.15, 0.2],
        },
      },
    },
    Road: {
      type: "object",
      properties: {
        seed: { type: "integer", minimum: 0, maximum: 10, default: 1, title: "Seed", unit: "1", soft_range: [1, 5] },
        bump: { $ref: "#/$defs/Bump", default: { shape: "cosine", height: 0.1 } },
      },
    },
    Mpc: {
      type: "object",
      properties: {
        lag: {
          anyOf: [{ type: "number", minimum: 0.5, maximum: 1000 }, { type: "null" }],
          default: null,
          title: "Bandwidth",
          search_words: ["frequency", "response"],
          unit: "Hz",
          soft_range: [2, 50],
        },
        force_weight: {
          type: "number",
          minimum: 1e-12,
          maximum: 1e-3,
          default: 1e-9,
          title: "R",
          unit: "1/N^2",
          soft_range: [1e-10, 1e-7],
        },
        weights: {
          type: "array",
          prefixItems: [weight, weight],
          default: [8, 1],
          title: "Cruise",
          search_words: ["comfort", "ride"],
          unit: "1",
          soft_range: [0, 10],
          item_titles: ["Body", "Pitch"],
        },
      },
    },
  },
  type: "object",
  properties: { road: { $ref: "#/$defs/Road", title: "Road" }, mpc: { $ref: "#/$defs/Mpc", title: "MPC" } },
};

export const FORM = readSchema(SCHEMA);
