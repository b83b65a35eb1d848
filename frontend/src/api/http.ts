/** How the page asks the server: addresses, answers, refusals. */

import { connection, tokenWanted } from "./connection";
import { ApiProblem, Unreachable, isAbort, isTransient, readProblem } from "./problem";

export const BASE = "/api/v1";

/** An answer that is not a refusal. */
export async function send(path: string, init: RequestInit): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(path, init);
  } catch (error) {
    if (isAbort(error)) throw error;
    connection.lost("down");
    throw new Unreachable();
  }
  if (response.ok) return response;
  const body = parse(await readText(response));
  const problem = readProblem(response.status, body, response.headers.get("retry-after"));
  if (problem.status === 502 || problem.status === 504) connection.lost("down");
  else if (isTransient(problem)) connection.lost("busy", problem.retryAfter ?? 0);
  else if (problem.kind === "token-required") tokenWanted.set(true);
  throw problem;
}

async function request(path: string, init: RequestInit): Promise<unknown> {
  const body = parse(await readText(await send(path, init)));
  if (body === undefined) throw new ApiProblem(502, "The server's answer could not be read", []);
  connection.ok();
  return body;
}

async function readText(response: Response): Promise<string> {
  try {
    return await response.text();
  } catch (error) {
    if (isAbort(error)) throw error;
    connection.lost("down");
    throw new Unreachable();
  }
}

function parse(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return undefined;
  }
}

// The one place where an answer gets its type: the contract is the backend's, checked there against its OpenAPI.
export async function get<T>(path: string, signal?: AbortSignal): Promise<T> {
  return (await request(BASE + path, signal ? { signal } : {})) as T;
}

interface PostOptions {
  readonly signal?: AbortSignal | undefined;
  readonly headers?: Readonly<Record<string, string>>;
}

export function sending(method: string, body: unknown, { signal, headers = {} }: PostOptions = {}): RequestInit {
  return {
    method,
    headers: { "content-type": "application/json", ...headers },
    body: JSON.stringify(body),
    ...(signal ? { signal } : {}),
  };
}

export async function post<T>(path: string, body: unknown, options?: PostOptions): Promise<T> {
  return (await request(BASE + path, sending("POST", body, options))) as T;
}

/** A file as it is. */
export async function postFile<T>(path: string, content: string, type: string): Promise<T> {
  return (await request(BASE + path, { method: "POST", headers: { "content-type": type }, body: content })) as T;
}

export async function patch<T>(path: string, body: unknown): Promise<T> {
  return (await request(BASE + path, sending("PATCH", body))) as T;
}

export async function remove(path: string): Promise<void> {
  await send(BASE + path, { method: "DELETE" });
}

export function asQuery(values: Readonly<Record<string, string>>): string {
  const text = new URLSearchParams(values).toString();
  return text === "" ? "" : `?${text}`;
}
