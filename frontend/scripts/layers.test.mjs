// The rules of dependency-cruiser.config.js find what they forbid: each case is a small source tree of its own.
import { mkdir, mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { cruise } from "dependency-cruiser";
import { expect, test } from "vitest";
import { forbidden } from "../dependency-cruiser.config.js";

/** The names of the rules that a tree breaks; each file is written with what it imports. */
async function broken(files) {
  const baseDir = await mkdtemp(join(tmpdir(), "layers-"));
  try {
    for (const [name, imports] of Object.entries(files)) {
      await mkdir(dirname(join(baseDir, name)), { recursive: true });
      await writeFile(join(baseDir, name), `${imports.map((from) => `import "${from}";\n`).join("")}export {};\n`);
    }
    const { output } = await cruise(["src"], { baseDir, validate: true, ruleSet: { forbidden } });
    return [...new Set(output.summary.violations.map(({ rule }) => rule.name))];
  } finally {
    await rm(baseDir, { recursive: true });
  }
}

test.each([
  ["no-import-upwards", { "src/lib/a.js": ["../ui/b"], "src/ui/b.js": [] }],
  ["no-import-upwards", { "src/lab/a.js": ["../plots/b"], "src/plots/b.js": [] }],
  ["no-import-upwards", { "src/features/share/a.js": ["../../app/b"], "src/app/b.js": [] }],
  ["no-page-in-another", { "src/pages/ecu/a.js": ["../lab/b"], "src/pages/lab/b.js": [] }],
  ["no-file-without-layer", { "src/shell/a.js": ["../lib/b"], "src/lib/b.js": [] }],
])("%s: %j", async (rule, files) => {
  expect(await broken(files)).toEqual([rule]);
});

test("a circle of files is found, and one of folders that no file is in", async () => {
  expect(await broken({ "src/lib/a.js": ["./b"], "src/lib/b.js": ["./a"] })).toEqual(["no-circle-of-files"]);
  const folders = {
    "src/lab/a.js": ["../server/b"],
    "src/server/b.js": [],
    "src/server/c.js": ["../lab/d"],
    "src/lab/d.js": [],
  };
  expect(await broken(folders)).toEqual(["no-circle-of-folders"]);
});

test("what lies below, beside, or is the lab's sweep is allowed", async () => {
  const files = {
    "src/app/a.js": ["../pages/lab/b"],
    "src/pages/lab/b.js": ["../sweep/SweepPage", "../../features/share/c"],
    "src/pages/sweep/SweepPage.tsx": [],
    "src/features/share/c.js": ["../tables/d", "../../lib/e"],
    "src/features/tables/d.js": ["../../lab/f"],
    "src/lab/f.js": ["../server/g"],
    "src/server/g.js": [],
    "src/lib/e.js": [],
  };
  expect(await broken(files)).toEqual([]);
});
