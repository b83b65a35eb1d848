/** How the page asks the server: addresses, answers, refusals. The backend's OpenAPI types every question and its answer. */

import { queryOptions } from "@tanstack/react-query";
import { connection, tokenWanted } from "./connection";
import { ApiProblem, Unreachable, isAbort, isTransient, readProblem } from "./problem";
import type { paths } from "./schema.gen";

const BASE = "/api/v1";

type Method = "get" | "post" | "patch" | "delete";
type Path<M extends Method> = {
  [P in keyof paths]: paths[P] extends Readonly<Record<M, unknown>> ? P : never;
}[keyof paths];
type Operation<M extends Method, P> = P extends keyof paths
  ? paths[P] extends Readonly<Record<M, infer O>>
    ? O
    : never
  : never;
type Body<O> = O extends { readonly requestBody: { readonly content: infer Content } }
  ? { readonly body: Content[keyof Content] }
  : unknown;
type Question<O> = (O extends { readonly parameters: infer Parameters } ? Parameters : unknown) & Body<O>;
type Json<Response> = Response extends { content: { readonly "application/json": infer Data } } ? Data : undefined;
/** What is submitted is answered with 202 or 201, a dry run of it with 200. */
type Status<Responses, Q> = 202 extends keyof Responses
  ? Q extends { readonly body: { readonly dry_run: true } }
    ? 200
    : 202
  : 201 extends keyof Responses
    ? Q extends { readonly query: { readonly dry_run: true } }
      ? 200
      : 201
    : keyof Responses;
type Answer<O, Q> = O extends { readonly responses: infer Responses }
  ? { [S in keyof Responses]: Json<Responses[S]> }[Status<Responses, Q> & keyof Responses]
  : never;

/** Any question, as it is sent. */
interface Sent {
  readonly path?: Readonly<Record<string, string>>;
  readonly query?: Readonly<Record<string, string | number | boolean | null>>;
  readonly header?: Readonly<Record<string, string>>;
  /** A text is a CSV file as it is, a blob a file of its type, all else JSON. */
  readonly body?: unknown;
}

/** Where a question is asked; the browser itself follows it to a download or a stream of events. */
export const address = <P extends Path<"get">>(path: P, question: Question<Operation<"get", P>> & Sent): string =>
  located(path, question);

function located(path: string, { path: names = {}, query = {} }: Sent): string {
  const stated = Object.entries(query).flatMap(([name, value]) => (value === null ? [] : [[name, String(value)]]));
  const text = new URLSearchParams(stated).toString();
  return (
    BASE + path.replace(/\{(\w+)\}/g, (_, name: string) => encodeURIComponent(names[name] ?? "")) + (text && `?${text}`)
  );
}

/** What the server answers, unless it refuses. */
export async function ask<M extends Method, P extends Path<M>, const Q extends Question<Operation<M, P>> & Sent>(
  method: M,
  path: P,
  question: Q,
  signal?: AbortSignal,
): Promise<Answer<Operation<M, P>, Q>> {
  const response = await send(method, path, question, signal);
  const body = response.status === 204 ? undefined : parse(await read(response.text()));
  if (body === undefined && response.status !== 204)
    throw new ApiProblem(502, "The server's answer could not be read", []);
  connection.ok();
  // The one place where an answer gets its type: the backend checks each against this same description.
  return body as Answer<Operation<M, P>, Q>;
}

/** A question with its key, for TanStack Query. */
export const query = <P extends Path<"get">, Q extends Question<Operation<"get", P>> & Sent>(path: P, question: Q) =>
  queryOptions({ queryKey: [path, question], queryFn: ({ signal }) => ask("get", path, question, signal) });

/** A file in place of JSON, in the form in which it is used. */
export const askFile = async <M extends Method, P extends Path<M>, Content>(
  method: M,
  path: P,
  question: Question<Operation<M, P>> & Sent,
  contentOf: (response: Response) => Promise<Content>,
  signal?: AbortSignal,
): Promise<Content> => {
  const content = await read(contentOf(await send(method, path, question, signal)));
  connection.ok();
  return content;
};

async function send(
  method: Method,
  path: string,
  { header, body, ...rest }: Sent,
  signal?: AbortSignal,
): Promise<Response> {
  const [type, content] =
    body instanceof Blob
      ? [body.type, body]
      : typeof body === "string"
        ? ["text/csv", body]
        : ["application/json", JSON.stringify(body)];
  const sent =
    body === undefined ? { headers: { ...header } } : { headers: { ...header, "content-type": type }, body: content };
  const response = await read(
    fetch(located(path, rest), { method: method.toUpperCase(), signal: signal ?? null, ...sent }),
  );
  if (response.ok) return response;
  const problem = readProblem(response.status, parse(await read(response.text())), response.headers.get("retry-after"));
  if (problem.status === 502 || problem.status === 504) connection.lost("down");
  else if (isTransient(problem)) connection.lost("busy", problem.retryAfter ?? 0);
  else if (problem.kind === "token-required") tokenWanted.set(true);
  throw problem;
}

/** What comes over the network, as far as it comes. */
function read<Value>(coming: Promise<Value>): Promise<Value> {
  return coming.catch((error: unknown) => {
    if (isAbort(error)) throw error;
    connection.lost("down");
    throw new Unreachable();
  });
}

function parse(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return undefined;
  }
}
