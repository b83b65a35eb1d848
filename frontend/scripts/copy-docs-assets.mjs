// The API's documentation page is served without a CDN: its two files come from the swagger-ui-dist package.
import { cp, mkdir } from "node:fs/promises";

const root = new URL("..", import.meta.url);
const target = new URL("dist/docs-assets/", root);

await mkdir(target, { recursive: true });
for (const name of ["swagger-ui.css", "swagger-ui-bundle.js"]) {
  await cp(new URL(`node_modules/swagger-ui-dist/${name}`, root), new URL(name, target));
}
