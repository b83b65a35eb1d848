import { readdirSync, readFileSync } from "node:fs";
import postcss, { Rule } from "postcss";
import { expect, it } from "vitest";

/** A file's text by its name. */
const read = (ending) =>
  Object.fromEntries(
    readdirSync("src", { recursive: true, encoding: "utf8" })
      .filter((file) => file.endsWith(ending))
      .map((file) => [file, readFileSync(`src/${file}`, "utf8")]),
  );
const sheets = read(".module.css");

/** Selectors at the top level of a sheet or of an at-rule such as `@media`. */
function selectorsOf(text) {
  const selectors = [];
  postcss.parse(text).walkRules(({ parent, selectors: own }) => {
    const isNested = parent instanceof Rule || (parent?.type === "atrule" && parent.name.endsWith("keyframes"));
    if (!isNested) selectors.push(...own);
  });
  return selectors;
}

// A sheet is loaded with its page and stays: what it says of no class of its own, it says of every page after it.
it("A module's styles are of its own classes alone", () => {
  const unscoped = Object.entries(sheets).flatMap(([file, text]) =>
    selectorsOf(text)
      .filter((selector) => !/\.[a-z]/i.test(selector))
      .map((selector) => `${file}: ${selector}`),
  );
  expect(Object.keys(sheets).length).toBeGreaterThan(10);
  expect(unscoped).toEqual([]);
});

// Else any element that comes or goes has all of the page styled anew: 20 ms.
it("no style of an element depends on what is in another one around it", () => {
  const around = Object.entries(sheets).flatMap(([file, text]) =>
    selectorsOf(text)
      .filter((selector) => /:has\(.*\)[^,]*[\s>+~]/.test(selector))
      .map((selector) => `${file}: ${selector}`),
  );
  expect(around).toEqual([]);
});

it("every attribute that a style asks for is set by a component", () => {
  const code = Object.values(read(".tsx")).join("\n");
  const asked = Object.values(sheets).flatMap((text) =>
    [...text.matchAll(/\[(data-[a-z-]+)/g)].map(([, name]) => name),
  );
  expect([...new Set(asked)].filter((name) => !code.includes(name))).toEqual([]);
});

it("there are five sizes of type, the theme's", () => {
  const others = Object.entries(sheets).flatMap(([file, text]) =>
    [...text.matchAll(/font-size: (.*);/g)]
      .map(([, size]) => size)
      .filter((size) => size !== "inherit" && !/^var\(--mantine-font-size-(xs|sm|md|lg|xl)\)$/.test(size))
      .map((size) => `${file}: ${size}`),
  );
  expect(others).toEqual([]);
});
