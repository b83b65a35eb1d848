/** What this browser stores of the page for its next visit. */

/** `null` where the browser forbids it. */
export function ownStorage(): Storage | null {
  try {
    return window.localStorage;
  } catch {
    return null;
  }
}

/** What the browser keeps until somebody removes it, or with the tab alone. */
type StorageName = "localStorage" | "sessionStorage";

/** `null` where there is nothing, nothing that can be read, or the browser stores nothing. */
export function readStored(name: string, storage: StorageName = "localStorage"): unknown {
  try {
    return JSON.parse(globalThis[storage].getItem(name) ?? "null");
  } catch {
    return null;
  }
}

/** `null` removes it. Does nothing where the storage is full or forbidden. */
export function writeStored(name: string, value: unknown, storage: StorageName = "localStorage"): void {
  try {
    if (value === null) globalThis[storage].removeItem(name);
    else globalThis[storage].setItem(name, JSON.stringify(value));
  } catch {
    // Then the next visit begins without it.
  }
}

/** Whether a stored value has the template's shape: a list is of what its first item is, or of texts; of several items it has as many. */
export function isLike<T>(template: T, value: unknown): value is T {
  if (template === null) return value === null || typeof value === "string";
  if (Array.isArray(template))
    return (
      Array.isArray(value) &&
      (template.length < 2 || value.length === template.length) &&
      value.every((item) => isLike<unknown>(template.length > 0 ? template[0] : "", item))
    );
  if (typeof template !== "object") return typeof value === typeof template;
  return (
    typeof value === "object" &&
    value !== null &&
    Object.entries(template).every(([key, part]) => isLike(part, (value as Readonly<Record<string, unknown>>)[key]))
  );
}
