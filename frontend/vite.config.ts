import { fileURLToPath } from "node:url";
import react from "@vitejs/plugin-react";
import { defineConfig } from "vitest/config";

const backend = process.env.RIDELAB_BACKEND ?? "http://127.0.0.1:8000";

export default defineConfig({
  plugins: [react()],
  // plotly.js names the styles of its maps, which are not in our bundle.
  resolve: { alias: { "maplibre-gl/dist/maplibre-gl.css": fileURLToPath(new URL("src/plots/no-maps.css", import.meta.url)) } },
  define: { global: "globalThis" }, // plotly.js's parts were written for node's name of it
  server: { proxy: { "/api": backend, "/healthz": backend, "/readyz": backend } },
  build: {
    target: "es2022",
    chunkSizeWarningLimit: 1300, // plotly.js is one file
    // An inlined asset would be a data: address, which the page's content security policy forbids.
    assetsInlineLimit: 0,
    reportCompressedSize: false, // nobody reads it there
  },
  test: { include: ["src/**/*.test.ts"], environment: "node", isolate: false },
});
