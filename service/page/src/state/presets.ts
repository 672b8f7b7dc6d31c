/** The presets of the service, and which of them is opened. */

import { effect, signal } from "@preact/signals";

import { loseConnection, returns } from "./connection";
import { open } from "./editor";
import { lookup } from "./lookup";
import type { SpecDocument } from "../film/document";
import type { PresetEntry } from "../service/answers";
import { LostError, ProblemError } from "../service/problem";
import { preset, presets } from "../service/service";

/** All presets; none until the film itself has its first colours. */
export const allPresets = signal<readonly PresetEntry[]>([]);

/** How many pictures are there: the next one is asked for then, so that they do not stand in the film's way. */
export const picturesDone = signal(0);

/** Ask for the presets once there is something to see, and again when the service comes back. */
export function followPresets(): () => void {
  return effect(() => {
    returns.value;
    const { answer, problem } = lookup.value;
    if ((answer ?? problem) === undefined || allPresets.peek().length > 0) return;
    void unlessLost(async () => void (allPresets.value = await presets()));
  });
}

/** Put a preset on the page. */
export async function openPreset(name: string): Promise<void> {
  await unlessLost(async () => open((await preset(name)).spec as unknown as SpecDocument, name));
}

/** A refusal, for want of a key, is answered where the key is asked for. */
async function unlessLost(work: () => Promise<void>): Promise<void> {
  try {
    await work();
  } catch (error) {
    if (error instanceof LostError) loseConnection();
    else if (!(error instanceof ProblemError)) throw error;
  }
}
