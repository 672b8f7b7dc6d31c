/** The page's tokens, for what is drawn by script and not by a style sheet. */

import { signal } from "@preact/signals";

/** Counts the changes of the theme: what reads it is drawn again. */
export const theme = signal(0);

const changed = () => theme.value++;
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", changed);
new MutationObserver(changed).observe(document.documentElement, { attributeFilter: ["data-theme", "class"] });

/** A token of the page, such as --ink. */
export function token(name: `--${string}`): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim() || "#888";
}

/** A font for drawings: the page's own, small. */
export function plotFont(): string {
  return `12px ${getComputedStyle(document.body).fontFamily}`;
}
