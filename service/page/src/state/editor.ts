/** The spec that is on the page, and how it came there: every change can be taken back. */

import { computed, signal } from "@preact/signals";

import type { Change, SpecDocument } from "../film/document";

const MOST_STEPS = 200;

interface History {
  readonly past: readonly SpecDocument[];
  readonly future: readonly SpecDocument[];
}

const history = signal<History>({ past: [], future: [] });
const present = signal<SpecDocument>({
  name: "Film on glass",
  stack: { incident: "air", substrate: { n: 1.5 }, layers: [{ material: { n: 2 }, thickness_nm: 420 }] },
});

/** The spec on the page. */
export const spec = computed(() => present.value);
/** Name of the preset that was opened, while it is unchanged, or after all changes have been taken back. */
export const openedPreset = signal("");
export const canUndo = computed(() => history.value.past.length > 0);
export const canRedo = computed(() => history.value.future.length > 0);

/** Change the spec. Changes of one `gesture`, such as the drag of a slider, are taken back together. */
export function edit(change: Change, gesture = ""): void {
  const changed = change(present.value);
  if (changed === present.value) return;
  if (!gesture || gesture !== lastGesture) remember();
  lastGesture = gesture;
  openedPreset.value = "";
  present.value = changed;
}

/** Put another spec on the page. */
export function open(document: SpecDocument, preset = ""): void {
  remember();
  lastGesture = "";
  present.value = document;
  openedPreset.value = preset;
  if (preset) presetNames.set(document, preset);
}

/** A gesture has ended: the next change of the same kind is taken back on its own. */
export function endGesture(): void {
  lastGesture = "";
}

export function undo(): void {
  const { past, future } = history.value;
  const last = past.at(-1);
  if (last === undefined) return;
  history.value = { past: past.slice(0, -1), future: [present.value, ...future] };
  go(last);
}

export function redo(): void {
  const { past, future } = history.value;
  const [next, ...later] = future;
  if (next === undefined) return;
  history.value = { past: [...past, present.value], future: later };
  go(next);
}

let lastGesture = "";
const presetNames = new WeakMap<SpecDocument, string>();

function remember(): void {
  history.value = { past: [...history.value.past, present.value].slice(-MOST_STEPS), future: [] };
}

function go(document: SpecDocument): void {
  lastGesture = "";
  openedPreset.value = presetNames.get(document) ?? "";
  present.value = document;
}
