/** A film and how it is looked at, as the fragment of an address: what is behind its #, which no server sees. */

import { brief } from "./brief";
import type { SpecDocument } from "./document";
import { isReadable, isRecord } from "./readable";
import { LIGHTS, SHAPES, type Light, type Shape } from "../state/view";

/** How the film is looked at. */
export interface View {
  readonly shape: Shape;
  readonly light: Light;
  readonly thetaDegrees: number;
}

/** What a link says: a film, or the name of a preset; and the view, as far as it says one. */
export type Link = { readonly view: Partial<View> } & ({ readonly spec: SpecDocument } | { readonly preset: string });

const LONGEST_JSON = 4_000_000;
/** A link chooses among presets, and nothing else of the service: no name climbs out of their path. */
const PRESET_NAME = /^[\w-]+(\/[\w-]+)*$/;
const LARGEST_THETA_DEGREES = 89;

/** What is wrong with a link. */
export class LinkError extends Error {
  override readonly name = "LinkError";
}

export async function filmFragment(spec: SpecDocument, view: View): Promise<string> {
  return `film=${toBase64Url(await deflated(JSON.stringify({ spec: brief(spec), view })))}`;
}

/** A preset's own link; the view is said where it is not that of a page just opened. */
export function presetFragment(name: string, view: Partial<View>): string {
  const parameters = Object.entries(view).map(([field, value]) => `&${field}=${encodeURIComponent(value)}`);
  return `preset=${name}${parameters.join("")}`;
}

/** What a fragment says; undefined where it says nothing of ours. @throws LinkError */
export async function readFragment(fragment: string): Promise<Link | undefined> {
  const parameters = new URLSearchParams(fragment.replace(/^#/, ""));
  const [film, preset] = [parameters.get("film"), parameters.get("preset")];
  if (film !== null) return filmLink(film);
  if (preset === null) return undefined;
  if (!PRESET_NAME.test(preset)) throw new LinkError("the link names no preset");
  const theta = parameters.get("thetaDegrees");
  return { preset, view: viewOf({ ...Object.fromEntries(parameters), thetaDegrees: theta === null ? undefined : Number(theta) }) };
}

async function filmLink(film: string): Promise<Link> {
  const { spec, view }: { spec?: unknown; view?: unknown } = await documentOf(film);
  if (!isReadable(spec)) throw new LinkError("the link holds no film: it has parts that cannot be read");
  return { spec, view: viewOf(isRecord(view) ? view : {}) };
}

async function documentOf(film: string): Promise<Record<string, unknown>> {
  let document: unknown;
  try {
    document = JSON.parse(await inflated(fromBase64Url(film)));
  } catch (error) {
    if (error instanceof LinkError) throw error;
    throw new LinkError("the link is damaged: it may have been cut off where it was copied", { cause: error });
  }
  if (!isRecord(document)) throw new LinkError("the link holds no film");
  return document;
}

function viewOf({ shape, light, thetaDegrees }: Record<string, unknown>): Partial<View> {
  const isAngle = typeof thetaDegrees === "number" && thetaDegrees >= 0 && thetaDegrees <= LARGEST_THETA_DEGREES;
  return {
    ...(SHAPES.includes(shape as Shape) ? { shape: shape as Shape } : {}),
    ...(LIGHTS.includes(light as Light) ? { light: light as Light } : {}),
    ...(isAngle ? { thetaDegrees } : {}),
  };
}

async function deflated(text: string): Promise<Uint8Array> {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** A few bytes can inflate to more than a page can hold: it stops there. */
async function inflated(bytes: Uint8Array<ArrayBuffer>): Promise<string> {
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let length = 0;
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    length += part.value.length;
    if (length > LONGEST_JSON) throw new LinkError("the link holds more than a film");
    parts.push(part.value);
  }
  return new Blob(parts).text();
}

function toBase64Url(bytes: Uint8Array): string {
  const text = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

function fromBase64Url(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
}
