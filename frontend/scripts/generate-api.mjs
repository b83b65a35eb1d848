// Writes src/api/schema.gen.ts from the backend's OpenAPI: `npm run api -- http://127.0.0.1:8000/openapi.json` (or a file).
import { writeFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";
import openapiTS, { astToString } from "openapi-typescript";

const source = process.argv[2] ?? "http://127.0.0.1:8000/openapi.json";
const url = source.startsWith("http") ? new URL(source) : pathToFileURL(source);
const nodes = await openapiTS(url, { alphabetize: true });
const target = new URL("../src/api/schema.gen.ts", import.meta.url);
await writeFile(target, `// Generated from the backend's OpenAPI by \`npm run api\`; do not edit.\n\n${astToString(nodes)}`);
console.log("wrote src/api/schema.gen.ts");
