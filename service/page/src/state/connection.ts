/** Whether the service answers. Once it does not, it is asked again and again, and all that was wanted is asked anew. */

import { signal } from "@preact/signals";

import { isAlive } from "../service/service";

const PAUSES_MS = [250, 500, 1000, 2000] as const;
const LONGEST_PAUSE_MS = 4000;

export const lost = signal(false);
/** How often the service has come back: an effect that reads it runs again when it does. */
export const returns = signal(0);

/** The service has not answered. */
export function loseConnection(): void {
  if (lost.value) return;
  lost.value = true;
  void awaitReturn();
}

async function awaitReturn(): Promise<void> {
  for (let attempt = 0; !(await isAlive()); attempt++) {
    await new Promise((resolve) => setTimeout(resolve, PAUSES_MS[attempt] ?? LONGEST_PAUSE_MS));
  }
  lost.value = false;
  returns.value++;
}
