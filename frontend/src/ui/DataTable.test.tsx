// @vitest-environment happy-dom
import { MantineProvider } from "@mantine/core";
import { cleanup, render, screen } from "@testing-library/react";
import userEvent from "@testing-library/user-event";
import { afterEach, expect, it } from "vitest";
import { DataTable } from "./DataTable";

interface Row {
  readonly name: string;
  readonly peak: number | null;
}

const ROWS: readonly Row[] = [
  { name: "LV", peak: 2 },
  { name: "passive", peak: null },
  { name: "LQR", peak: -1 },
];
const names = () => screen.getAllByRole("rowheader").map(({ textContent }) => textContent);

afterEach(cleanup);

const table = (props: Partial<Parameters<typeof DataTable<Row>>[0]> = {}) =>
  render(
    <MantineProvider>
      <DataTable
        label="Peaks"
        rows={ROWS}
        rowKey={({ name }) => name}
        columns={[
          { key: "name", head: "Strategy", cell: ({ name }) => name },
          { key: "peak", head: "Peak", detail: "m/s²", cell: ({ peak }) => peak ?? "–", sort: ({ peak }) => peak },
        ]}
        {...props}
      />
    </MantineProvider>,
  );

it("sorts up, down and not at all by a column's head, what has no value last", async () => {
  table();
  const user = userEvent.setup();
  const head = screen.getByRole("columnheader", { name: "Peak m/s²" });
  expect([head.ariaSort ?? head.getAttribute("aria-sort"), names()]).toEqual(["none", ["LV", "passive", "LQR"]]);
  const seen = [];
  for (const key of ["{Enter}", " ", "{Enter}"]) {
    screen.getByRole("button", { name: "Peak m/s²" }).focus();
    await user.keyboard(key);
    seen.push([head.getAttribute("aria-sort"), names()]);
  }
  expect(seen).toEqual([
    ["ascending", ["LQR", "LV", "passive"]],
    ["descending", ["LV", "LQR", "passive"]],
    ["none", ["LV", "passive", "LQR"]],
  ]);
});

it("says what it is of, and why it is empty, where it can be reached by keys", () => {
  table({ rows: [], empty: "No run yet" });
  const region = screen.getByRole("region", { name: "Peaks" });
  expect(region.tabIndex).toBe(0);
  expect(region.textContent).toContain("No run yet");
  expect(screen.getByRole("table", { name: "Peaks" })).toBeTruthy();
});
