/** The address bar always holds the link to what is on the page, and what a link says is opened. */

import { effect, signal } from "@preact/signals";

import { open, openedPreset, spec } from "./editor";
import { light, LIGHTS, shape, SHAPES, thetaDegrees } from "./view";
import type { SpecDocument } from "../film/document";
import { filmFragment, type Link, LinkError, presetFragment, readFragment, type View } from "../film/permalink";
import { LostError, ProblemError } from "../service/problem";
import { preset } from "../service/service";

const REST_MS = 300;
const FIRST_VIEW: View = { shape: SHAPES[0], light: LIGHTS[0], thetaDegrees: 0 };

/** What is wrong with the link that was followed, in words. */
export const linkMessage = signal("");
/** The address of what is on the page. */
export const permalink = signal(location.href);

/** Open what the address says, and from then on keep it current. Resolves once the film is there. */
export async function followLink(): Promise<void> {
  addEventListener("hashchange", () => void openLink());
  await openLink();
  const opened = spec.peek();
  effect(() => {
    const [document, name, view] = [spec.value, openedPreset.value, currentView()];
    const timer = setTimeout(() => void keepAddress(document, name, view, opened), REST_MS);
    return () => clearTimeout(timer);
  });
}

async function openLink(): Promise<void> {
  handled = location.hash;
  linkMessage.value = "";
  try {
    const link = await readFragment(location.hash);
    if (link) await show(link);
  } catch (error) {
    linkMessage.value = `This link could not be opened: ${reason(error)}. Here is the film that was on the page.`;
  }
}

async function show(link: Link): Promise<void> {
  if ("spec" in link) open(link.spec);
  else open((await preset(link.preset)).spec as unknown as SpecDocument, link.preset);
  shape.value = link.view.shape ?? shape.value;
  light.value = link.view.light ?? light.value;
  thetaDegrees.value = link.view.thetaDegrees ?? thetaDegrees.value;
}

function reason(error: unknown): string {
  if (error instanceof LinkError || error instanceof ProblemError || error instanceof LostError) return error.message;
  throw error;
}

function currentView(): View {
  return { shape: shape.value, light: light.value, thetaDegrees: thetaDegrees.value };
}

/** The fragment that the page has opened or written. */
let handled = "";

async function keepAddress(document: SpecDocument, name: string, view: View, opened: SpecDocument): Promise<void> {
  const fragment = name ? presetFragment(name, changedView(view)) : await filmFragment(document, view);
  if (document !== spec.peek()) return; // changed meanwhile: a later call writes
  if (location.hash !== handled) return; // another link has been entered, and is about to be opened
  permalink.value = new URL(`#${fragment}`, location.href).href;
  // The address of a page that has just been opened stays as short as it is.
  if (location.hash || document !== opened) history.replaceState(history.state, "", permalink.value);
  handled = location.hash;
}

function changedView(view: View): Partial<View> {
  const changed = Object.entries(view).filter(([field, value]) => value !== FIRST_VIEW[field as keyof View]);
  return Object.fromEntries(changed);
}
