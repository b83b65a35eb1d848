/** What went wrong with a request, in the kinds the page treats differently. */

export interface FieldError {
  /** JSON pointer into the request body, e.g. `/scenario/road/bump/height`. */
  readonly pointer: string;
  readonly message: string;
}

/** The server answered with an RFC 9457 problem. */
export class ApiProblem extends Error {
  readonly status: number;
  readonly errors: readonly FieldError[];
  readonly retryAfter: number | null;
  /** The kind's short name, such as `store-unavailable`. */
  readonly kind: string | null;

  constructor(
    status: number,
    message: string,
    errors: readonly FieldError[],
    retryAfter: number | null = null,
    kind: string | null = null,
  ) {
    super(message);
    this.name = "ApiProblem";
    this.status = status;
    this.errors = errors;
    this.retryAfter = retryAfter;
    this.kind = kind;
  }
}

/** No usable answer at all: the server is down, or something between here and there is. */
export class Unreachable extends Error {
  constructor() {
    super("The server does not answer");
    this.name = "Unreachable";
  }
}

const TRANSIENT = new Set([429, 502, 503, 504]);

/** Whether the same request may succeed later without anybody doing anything. */
export function isTransient(error: unknown): boolean {
  return error instanceof Unreachable || (error instanceof ApiProblem && TRANSIENT.has(error.status));
}

/** What to change where the server says that, else what went wrong. */
export const explain = (error: Error): string =>
  (error instanceof ApiProblem ? error.errors[0]?.message : undefined) ?? error.message;

/** What went wrong, whatever was thrown. */
export const messageOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));

export function isNotFound(error: unknown): boolean {
  return error instanceof ApiProblem && error.status === 404;
}

export function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === "AbortError";
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null;
}

/** Reads a problem+json body; anything unexpected still gives a usable message. */
export function readProblem(status: number, body: unknown, retryAfter: string | null): ApiProblem {
  const problem = isRecord(body) ? body : {};
  const listed = Array.isArray(problem.errors) ? problem.errors : [];
  const errors = listed
    .filter(isRecord)
    .flatMap((entry): FieldError[] =>
      typeof entry.pointer === "string" && typeof entry.message === "string"
        ? [{ pointer: entry.pointer, message: entry.message }]
        : [],
    );
  const text = [problem.detail, problem.title].find((value) => typeof value === "string" && value !== "");
  const seconds = retryAfter === null ? NaN : Number(retryAfter);
  return new ApiProblem(
    status,
    typeof text === "string" ? text : `The server answered ${status}`,
    errors,
    Number.isFinite(seconds) ? seconds : null,
    typeof problem.type === "string" ? (/^urn:problem-type:ridelab:(.+)$/.exec(problem.type)?.[1] ?? null) : null,
  );
}
