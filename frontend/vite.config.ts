/// <reference types="vitest/config" />
import { fileURLToPath } from "node:url";
import react from "@vitejs/plugin-react";
import { defineConfig } from "vite";

const backend = process.env.RIDELAB_BACKEND ?? "http://127.0.0.1:8000";

// plotly.js describes every attribute for its documentation, 0.2 MB of text; its own builds leave the texts out too.
const withoutDescriptions = {
  name: "plotly-without-descriptions",
  transform: (code: string, id: string) =>
    /plotly\.js[\\/]src[\\/]/.test(id) ? { code: code.replace(DESCRIPTION, ""), map: null } : null,
};
const DESCRIPTION = /\s*description: (?:'.*'|\[[\s\S]*?\]\.join\([\s\S]*?\)),?$/gm;

export default defineConfig({
  plugins: [react(), withoutDescriptions],
  // plotly.js names the styles of its maps, which are not in our bundle.
  resolve: {
    alias: { "maplibre-gl/dist/maplibre-gl.css": fileURLToPath(new URL("src/plots/no-maps.css", import.meta.url)) },
  },
  define: { global: "globalThis" }, // plotly.js's parts were written for node's name of it
  server: { proxy: { "/api": backend, "/healthz": backend, "/readyz": backend } },
  build: {
    target: "es2022",
    chunkSizeWarningLimit: 1300, // plotly.js is one file
    // An inlined asset would be a data: address, which the page's content security policy forbids.
    assetsInlineLimit: 0,
    reportCompressedSize: false, // nobody reads it there
    license: { fileName: "licenses.md" }, // of all that is bundled; copy-docs-assets.mjs adds the icons
    // What the first view needs is one file, and so is what several others need: in fifty the browser's six connections
    // take turns. plotly.js stays apart.
    rolldownOptions: {
      output: {
        codeSplitting: {
          groups: [
            { name: "first", tags: ["$initial"], priority: 1 },
            { name: "shared", minShareCount: 2, test: /^(?!.*plotly)/ },
          ],
        },
      },
    },
  },
  // Files without a page share what they import: in a process of its own each would read half of the sources again.
  // They run behind everything else on a busy machine, so none of them is in a hurry.
  test: {
    testTimeout: 120_000,
    setupFiles: "scripts/patience.mjs",
    include: ["src/**/*.test.{ts,tsx}", "scripts/*.test.mjs"],
    environment: "node",
    isolate: false,
  },
});
