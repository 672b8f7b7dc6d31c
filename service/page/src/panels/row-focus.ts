/** Where the focus goes, and what is read out, when rows of the stack change places. */

import { signal } from "@preact/signals";

import type { Place } from "../film/document";

/** The last change of the stack, in words. */
export const stackNews = signal("");

export type RowAction = "up" | "down" | "remove";

/** The row of a place, as the document marks it. */
export function rowName({ entry, member }: Place): string {
  return member === undefined ? `${entry}` : `${entry}.${member}`;
}

/** Focus a button of a row once it is drawn; its neighbour where that button is not to be had. */
export function focusRow(place: Place, action: RowAction): void {
  requestAnimationFrame(() => {
    const buttons = (row: string) => `[data-row="${row}"] [data-action="${action}"]`;
    const enabled = (row: string) => document.querySelector<HTMLElement>(`${buttons(row)}:not(:disabled)`);
    const row = rowName(place);
    const anyOfRow = document.querySelector<HTMLElement>(`[data-row="${row}"] .row-actions button:not(:disabled)`);
    (enabled(row) ?? anyOfRow ?? document.querySelector<HTMLElement>(".add-layer"))?.focus();
  });
}
