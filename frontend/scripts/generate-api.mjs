// Writes src/api/schema.gen.ts, or another file, from the backend's OpenAPI:
// `npm run api -- http://127.0.0.1:8000/openapi.json [target]` (or a file).
import { writeFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";
import openapiTS, { astToString } from "openapi-typescript";

const [source = "http://127.0.0.1:8000/openapi.json", target = new URL("../src/api/schema.gen.ts", import.meta.url)] = process.argv.slice(2);
const url = source.startsWith("http") ? new URL(source) : pathToFileURL(source);
const nodes = await openapiTS(url, { alphabetize: true });
await writeFile(target, `// Generated from the backend's OpenAPI by \`npm run api\`; do not edit.\n\n${astToString(nodes)}`);
console.log(`wrote ${target}`);
