/** A browser's storage of texts, for tests. */

export function memoryStorage(stored: Readonly<Record<string, string>> = {}): Storage {
  const texts = new Map(Object.entries(stored));
  return {
    get length() {
      return texts.size;
    },
    key: (index: number) => [...texts.keys()][index] ?? null,
    getItem: (key: string) => texts.get(key) ?? null,
    setItem: (key: string, text: string) => void texts.set(key, text),
    removeItem: (key: string) => void texts.delete(key),
    clear: () => texts.clear(),
  };
}

export const FULL_STORAGE = Object.assign(memoryStorage(), {
  setItem: () => {
    throw new DOMException("full", "QuotaExceededError");
  },
});
