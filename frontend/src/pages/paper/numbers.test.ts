import { describe, expect, it } from "vitest";
import { printedChange, printedValue, spreadOf, typeset } from "./numbers";

describe("the paper's numbers", () => {
  it("are as printed, also in another unit", () => {
    expect([0.83, 12.6, 5, 1.12].map((value) => printedValue(value, 1))).toEqual(["0.83", "12.6", "5.00", "1.12"]);
    expect([22245, 955.8, 968, 1356].map((value) => printedValue(value, 1e-3))).toEqual([
      "22.245",
      "0.9558",
      "0.968",
      "1.356",
    ]);
  });

  it("keep every digit of a change and its sign", () => {
    expect([-25.9, -7.54, 8.45, -44, 1.75].map(printedChange)).toEqual([
      "−25.9\u2009%",
      "−7.54\u2009%",
      "+8.45\u2009%",
      "−44.0\u2009%",
      "+1.75\u2009%",
    ]);
  });
});

describe("an interval", () => {
  it("is half its width where it lies evenly, else its ends", () => {
    expect(spreadOf(-11, [-13.1, -8.9])).toBe("±\u20092.1");
    expect(spreadOf(-11, [-15, -8.9])).toBe("−15.0 to −8.9");
    expect(spreadOf(-11, [NaN, NaN])).toBe("");
  });
});

it("sets the server's plain text", () => {
  expect(typeset("peaks -72 %, +4 % (-1 to 2) of the paper's one-way Eq. 11-15")).toBe(
    "peaks −72\u00a0%, +4\u00a0% (−1 to 2) of the paper’s one-way Eq. 11-15",
  );
});
