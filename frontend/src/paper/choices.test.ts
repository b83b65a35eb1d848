import { describe, expect, it } from "vitest";
import type { PaperReading } from "../api/types";
import { changedReadings, formatChoices, readChoices, withChoice, withoutChoices } from "./choices";

const READING: PaperReading = {
  id: "preview",
  title: "Road preview",
  description: "",
  chosen: "lookahead",
  choices: [
    { id: "lookahead", label: "Road ahead", default: true },
    { id: "none", label: "None", default: false },
  ],
};

describe("the chosen readings", () => {
  it.each(["", "?preview=none", "?preview=none&seeds=40"])("stand in the address: %s", (search) => {
    expect(formatChoices(readChoices(search))).toBe(search);
  });

  it("leave no trace where they are Ridelab's", () => {
    const chosen = withChoice({ seeds: "40" }, READING, "none");
    expect(chosen).toEqual({ seeds: "40", preview: "none" });
    expect(withChoice(chosen, READING, "lookahead")).toEqual({ seeds: "40" });
  });

  it("are reset without losing the rest of the address", () => {
    expect(withoutChoices({ seeds: "40", preview: "none" }, [READING])).toEqual({ seeds: "40" });
  });

  it("are told from Ridelab's", () => {
    expect(changedReadings([READING])).toEqual([]);
    expect(changedReadings([{ ...READING, chosen: "none" }])).toHaveLength(1);
  });
});
