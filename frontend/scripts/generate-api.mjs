// Writes src/api/schema.gen.ts, or another file, from the backend's OpenAPI:
// `npm run api -- http://127.0.0.1:8000/openapi.json [target]` (or a file).
import { readFile, writeFile } from "node:fs/promises";
import openapiTS, { astToString } from "openapi-typescript";

const [source = "http://127.0.0.1:8000/openapi.json", target = new URL("../src/api/schema.gen.ts", import.meta.url)] =
  process.argv.slice(2);
const description = JSON.parse(
  source.startsWith("http") ? await (await fetch(source)).text() : await readFile(source, "utf8"),
);

const BASE = "/api/v1";
const JSON_OBJECT = { $ref: "#/components/schemas/JsonObject" };
// The form is made from the scenario's schema at run time and reaches every field by its path.
const PLAIN = /\/(Scenario-Input|Scenario-Output|Vehicle)$/;
// What the catalogue and the form list at run time; by their number also signals, metrics and fields.
const LISTED = ["strategy", "window", "previews"];
const LONG_LIST = 9;
const UNTYPED = ["propertyNames", "default", "examples", "description", "title", "format", "example"];

const mapped = (object, change) =>
  Object.fromEntries(Object.entries(object).map(([key, value]) => [key, change(value, key)]));

/** A schema as the page reads it: a strategy or a field of a scenario added to the core needs no new page. */
function simplified(schema, name) {
  if (Array.isArray(schema)) return schema.map((each) => simplified(each, name));
  if (typeof schema !== "object" || schema === null) return schema;
  if (PLAIN.test(schema.$ref) || schema.additionalProperties === true) return JSON_OBJECT;
  if (schema.enum && (LISTED.includes(name) || schema.enum.length >= LONG_LIST)) return { type: "string" };
  const kept = Object.entries(schema).filter(([key]) => !UNTYPED.includes(key));
  return Object.fromEntries(
    kept.map(([key, value]) => [key, key === "properties" ? mapped(value, simplified) : simplified(value, name)]),
  );
}

/** Without refusals: the page reads them all in one place. */
function simplifiedOperation({ operationId, parameters = [], requestBody, responses }) {
  return {
    operationId,
    parameters: parameters.map(({ name, in: place, required, schema }) => ({
      name,
      in: place,
      required,
      schema: simplified(schema),
    })),
    ...(requestBody && { requestBody: { required: true, content: simplified(requestBody.content) } }),
    responses: mapped(
      Object.fromEntries(Object.entries(responses).filter(([status]) => status.startsWith("2"))),
      ({ content }) => ({
        description: "",
        ...(content && { content: simplified(content) }),
      }),
    ),
  };
}

/** Those schemas that the paths need. */
function reached(paths, all) {
  const schemas = {};
  const reach = (value) => {
    for (const [, name] of JSON.stringify(value).matchAll(/#\/components\/schemas\/([^"]+)/g)) {
      if (name in schemas) continue;
      schemas[name] = all[name];
      reach(all[name]);
    }
  };
  reach(paths);
  return schemas;
}

const served = Object.entries(description.paths).filter(([path]) => path.startsWith(BASE));
const paths = Object.fromEntries(
  served.map(([path, operations]) => [path.slice(BASE.length), mapped(operations, simplifiedOperation)]),
);
const schemas = reached(paths, {
  ...mapped(description.components.schemas, simplified),
  JsonObject: { type: "object" },
});
const { openapi, info } = description;
const inject = 'import type { JsonObject } from "./json";\n';
const options = {
  alphabetize: true,
  immutable: true,
  defaultNonNullable: false,
  rootTypes: true,
  rootTypesNoSchemaPrefix: true,
  inject,
};
const types = astToString(await openapiTS({ openapi, info, paths, components: { schemas } }, options))
  .replace(/^ +readonly JsonObject: .*\n|^export type (webhooks|\$defs|JsonObject) = .*\n/gm, "")
  .replace(/components\["schemas"\]\["JsonObject"\]/g, "JsonObject")
  .replace(/^ +headers: \{\n.*\n +\};\n/gm, "")
  .replace(/^ +readonly "?[\w-]+"?\?: never;\n/gm, "")
  .replace(/^ +readonly parameters: \{\n +\};\n/gm, "");
await writeFile(target, `// Generated from the backend's OpenAPI by \`npm run api\`; do not edit.\n\n${types}`);
console.log(`wrote ${target}`);
