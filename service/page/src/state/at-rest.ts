/** What is asked of the service once the page has come to rest. */

import { effect } from "@preact/signals";

import { returns } from "./connection";

/** Ask when nothing that `asked` reads has changed for a while, and anew when the service comes back. */
export function atRest<Asked>(restMs: number, asked: () => Asked | undefined, ask: (asked: Asked) => void): () => void {
  return effect(() => {
    returns.value; // asked anew when the service comes back
    const wanted = asked();
    if (wanted === undefined) return undefined;
    const timer = setTimeout(() => ask(wanted), restMs);
    return () => clearTimeout(timer);
  });
}
