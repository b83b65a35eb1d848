/** Searching texts for the words that somebody types. */

/** What is typed, word by word, as far as singular and plural share it. */
export const wordsOf = (text: string): readonly string[] => text.toLowerCase().split(/\s+/).filter(Boolean).map(stemOf);

/** Short words are taken as they are: of `gas` two letters would be left. */
const SHORT = 4;

const stemOf = (word: string) => (word.length > SHORT ? word.replace(/(ies|es|y|s)$/, "") : word);

/** Whether all of these stand in a text, or in words and whole phrases that people look for it by. */
export function hasWords(text: string, words: readonly string[], searchWords: readonly string[] = []): boolean {
  const isPhrase = (term: string) => term.includes(" ");
  const whole = [text, ...searchWords.filter((term) => !isPhrase(term))].join(" ").toLowerCase();
  const inPhrases = searchWords
    .filter(isPhrase)
    .map(wordsOf)
    .filter((phrase) => phrase.every((word) => words.includes(word)))
    .flat();
  return words.every((word) => whole.includes(word) || inPhrases.includes(word));
}
