import { describe, expect, it } from "vitest";
import type { PaperInterpretation, PaperReading } from "../../api/types";
import { parseSearch, stringifySearch } from "../../lab/address";
import { readChoices, setOf, standardOf, withChoice, withoutChoices, withSet } from "./choices";

const READING: PaperReading = {
  id: "preview",
  title: "Road preview",
  description: "",
  chosen: "lookahead",
  choices: [
    { id: "lookahead", label: "Road ahead", default: true, source: "ours" },
    { id: "none", label: "None", default: false, source: "ours" },
  ],
};

const set = (id: string, preview: string): PaperInterpretation => ({
  id,
  title: id,
  description: "",
  choices: { preview },
  changes: {},
  reached: 36,
  total: 48,
  counts: { reached: 36, smaller: 8, contradicts: 4 },
  simulated: { reached: 28, total: 40 },
  ecu: { reached: 8, total: 8 },
  agreement: { cells: 40, within: 10, in_interval: 0 },
});
const SETS = [set("default", "lookahead"), set("favourable", "none")];

describe("the chosen readings", () => {
  it.each(["", "?preview=none", "?preview=none&seeds=40", "?interpretation=favourable"])(
    "stand in the address: %s",
    (search) => {
      expect(stringifySearch(readChoices(parseSearch(search)))).toBe(search);
    },
  );

  it("leave no trace where their named set has them", () => {
    const choices = withChoice({ seeds: "40" }, "preview", "none", "lookahead");
    expect(choices).toEqual({ seeds: "40", preview: "none" });
    expect(withChoice(choices, "preview", "lookahead", "lookahead")).toEqual({ seeds: "40" });
  });

  it("are reset to their named set without losing the rest of the address", () => {
    const query = { seeds: "40", interpretation: "favourable" };
    expect(withoutChoices({ ...query, preview: "none" }, [READING])).toEqual(query);
  });

  it("are all those of a named set once it is chosen", () => {
    expect(withSet({ seeds: "40", preview: "none" }, [READING], "favourable")).toEqual({
      seeds: "40",
      interpretation: "favourable",
    });
    expect(withSet({ interpretation: "favourable", preview: "none" }, [READING], "default")).toEqual({});
  });

  it("stand where their named set has them, which is the default without a name", () => {
    expect(standardOf(READING, setOf({}, SETS))).toBe("lookahead");
    expect(standardOf(READING, setOf({ interpretation: "favourable" }, SETS))).toBe("none");
  });
});
