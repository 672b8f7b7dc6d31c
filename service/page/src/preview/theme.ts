/** Whether the page is light or dark: by the reader's choice, or else the system's. */

import { type ReadonlySignal, signal } from "@preact/signals";

import type { Theme } from "./backdrop";

const DARK = "(prefers-color-scheme: dark)";

/** Follow the theme until `ended` aborts. */
export function watchTheme(ended: AbortSignal): ReadonlySignal<Theme> {
  const theme = signal(current());
  const look = () => void (theme.value = current());
  matchMedia(DARK).addEventListener("change", look, { signal: ended });
  const chosen = new MutationObserver(look);
  chosen.observe(document.documentElement, { attributeFilter: ["data-theme"] });
  ended.addEventListener("abort", () => chosen.disconnect());
  return theme;
}

function current(): Theme {
  const chosen = document.documentElement.dataset.theme;
  if (chosen === "light" || chosen === "dark") return chosen;
  return matchMedia(DARK).matches ? "dark" : "light";
}
