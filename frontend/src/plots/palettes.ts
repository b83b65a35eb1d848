/** What plots draw their axes with, by colour scheme. */

export interface Palette {
  readonly text: string;
  readonly grid: string;
  readonly zero: string;
}

export const PALETTES: Readonly<Record<"light" | "dark", Palette>> = {
  light: { text: "#4a555b", grid: "rgba(120, 135, 142, 0.2)", zero: "rgba(120, 135, 142, 0.55)" },
  dark: { text: "#a9b3b9", grid: "rgba(140, 150, 156, 0.2)", zero: "rgba(140, 150, 156, 0.5)" },
};

/** What is printed or stands in a paper. */
export const ON_PAPER: Palette = {
  text: "#333c41",
  grid: "rgba(120, 135, 142, 0.25)",
  zero: "rgba(120, 135, 142, 0.6)",
};
