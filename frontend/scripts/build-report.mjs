// What draws the figures of reports, as one script for a page of its own: the lab's plotly.js and nothing else.
import { mkdir, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { build } from "vite";

const root = new URL("../", import.meta.url);
const [{ output }] = await build({
  root: fileURLToPath(root),
  logLevel: "warn",
  build: {
    write: false,
    lib: { entry: fileURLToPath(new URL("src/plots/bundle.ts", root)), formats: ["iife"], name: "Plotly" },
    rolldownOptions: { output: { codeSplitting: false } },
  },
});

await mkdir(new URL("dist/report/", root), { recursive: true });
await writeFile(new URL("dist/report/plotly.js", root), output.find(({ type }) => type === "chunk").code);
