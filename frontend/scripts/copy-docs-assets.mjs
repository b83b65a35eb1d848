// The API's documentation page is served without a CDN: its files come from the swagger-ui-dist package.
import { appendFile, cp, mkdir, readFile } from "node:fs/promises";

const root = new URL("..", import.meta.url);
const target = new URL("dist/docs-assets/", root);

await mkdir(target, { recursive: true });
for (const name of ["swagger-ui.css", "swagger-ui-bundle.js", "LICENSE", "NOTICE"]) {
  await cp(new URL(`node_modules/swagger-ui-dist/${name}`, root), new URL(name, target));
}

// The icons' shapes are a file of our own, so that the bundler does not know their licence.
const icons = await readFile(new URL("src/ui/iconShapes.LICENSE", root), "utf-8");
await appendFile(new URL("dist/licenses.md", root), `\n## Icons\n\n${icons}`);
