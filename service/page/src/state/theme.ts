/** Light or dark: as the system has it, or as it was chosen here, kept for the next visit. */

import { effect, signal } from "@preact/signals";

const STORED = "nacreous:theme";

export const THEMES = ["system", "light", "dark"] as const;
export type Theme = (typeof THEMES)[number];

export const theme = signal<Theme>(THEMES.find((known) => known === localStorage.getItem(STORED)) ?? "system");

effect(() => {
  const { dataset } = document.documentElement;
  if (theme.value === "system") delete dataset["theme"];
  else dataset["theme"] = theme.value;
  localStorage.setItem(STORED, theme.value);
});
