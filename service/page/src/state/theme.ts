/** Light or dark: as the system has it, or as it was chosen here, kept for the next visit. */

import { effect, signal } from "@preact/signals";

const STORED = "nacreous:theme";
const SYSTEM_IS_DARK = matchMedia("(prefers-color-scheme: dark)");

export const THEME_CHOICES = ["system", "light", "dark"] as const;
export type ThemeChoice = (typeof THEME_CHOICES)[number];
export type Theme = Exclude<ThemeChoice, "system">;

export const themeChoice = signal<ThemeChoice>(
  THEME_CHOICES.find((known) => known === localStorage.getItem(STORED)) ?? "system",
);
/** What the page is in. It changes once the style sheet has followed, so that what is drawn by script may read that. */
export const theme = signal<Theme>(settled());

effect(() => {
  const { dataset } = document.documentElement;
  if (themeChoice.value === "system") delete dataset["theme"];
  else dataset["theme"] = themeChoice.value;
  localStorage.setItem(STORED, themeChoice.value);
  theme.value = settled();
});
SYSTEM_IS_DARK.addEventListener("change", () => (theme.value = settled()));

function settled(): Theme {
  if (themeChoice.peek() !== "system") return themeChoice.peek() as Theme;
  return SYSTEM_IS_DARK.matches ? "dark" : "light";
}
