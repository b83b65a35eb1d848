// Calls a service with nothing but what openapi-typescript generated from its description: `node generated_client.ts URL`.
import type { components, paths } from "./openapi.ts";

type Schemas = components["schemas"];
type Answer<Path extends keyof paths, Method extends keyof paths[Path], Status extends number> =
  paths[Path][Method] extends { responses: Record<Status, { content: { "application/json": infer Content } }> }
    ? Content
    : never;

const [address] = process.argv.slice(2);

async function ask<Content>(method: string, path: string, body?: unknown, type = "application/json"): Promise<Content> {
  const answer = await fetch(`${address}${path}`, {
    method,
    headers: body === undefined ? {} : { "Content-Type": type },
    body: typeof body === "string" || body === undefined ? body : JSON.stringify(body),
  });
  if (!answer.ok) {
    const problem = (await answer.json()) as Schemas["Problem"];
    throw new Error(`${problem.status} ${problem.type}: ${problem.detail}`);
  }
  return (await answer.json()) as Content;
}

const profile = ["distance [m],height [mm]", ...Array.from({ length: 200 }, (_, x) => `${x},${Math.sin(x)}`)].join("\n");
const road = await ask<Answer<"/api/v1/roads", "post", 201>>("POST", "/api/v1/roads", profile, "text/csv");
const asked: Schemas["RunRequest"] = {
  scenario: { road: { profile: road.id } },
  strategies: ["passive"],
  roads: 1,
};
const run = await ask<Answer<"/api/v1/runs", "post", 200>>("POST", "/api/v1/runs", asked);
const passive = run.strategies.passive;
if (passive?.status !== "ok" || (passive.travel_time ?? 0) <= 0) throw new Error("the run has no result");
const stored = await ask<Answer<"/api/v1/runs/{id}", "get", 200>>("GET", `/api/v1/runs/${run.id}`);
const sweep: Schemas["BatchRequest"] = {
  strategies: ["passive"],
  sweep: { grid: { "road.bump.height": [0.05, 0.06] } },
  dry_run: false,
};
const batch = await ask<Answer<"/api/v1/batches", "post", 202>>("POST", "/api/v1/batches", sweep);
const link = await ask<Answer<"/api/v1/links", "post", 201>>("POST", "/api/v1/links", { run_id: run.id });
const opened = await ask<Answer<"/api/v1/links/{slug}", "get", 200>>("GET", `/api/v1/links/${link.slug}`);
console.log(JSON.stringify([stored.id === run.id, batch.total, opened.run?.id === run.id, road.length]));
