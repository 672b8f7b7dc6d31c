/** The film's lookup textures: coarse ones while the spec changes, fine ones when it rests. */

import { effect } from "@preact/signals";
import type { LookupTexture } from "@nacreous/three";

import { returns } from "./connection";
import { follower } from "./asking";
import { spec } from "./editor";
import type { SpecDocument } from "../film/document";
import { COARSE, FINE, MIDDLE, lookupSpec, type Size } from "../film/views";
import type { TableAdded } from "../service/answers";
import { addTable, file, takesLong } from "../service/service";

const REST_MS = 200;

/** Whether the spec changes as one looks. */
export type Pace = "moving" | "resting";
/** Of these, the first that the service makes at once. */
const SIZES: Record<Pace, readonly [Size, ...Size[]]> = { moving: [COARSE], resting: [FINE, MIDDLE, COARSE] };

/** The colours of the film, and of what it lets through. */
export interface Lookup {
  readonly reflectance: LookupTexture;
  readonly transmittance?: LookupTexture;
  readonly table: TableAdded;
  readonly size: Size;
  readonly pace: Pace;
  /** The spec that the textures belong to. */
  readonly spec: SpecDocument;
}

const followed = follower(fetchLookup);
export const lookup = followed.state;

/** Follow the spec from now on. */
export function followSpec(): () => void {
  return effect(() => {
    const document = spec.value;
    returns.value; // asked anew when the service comes back
    followed.ask({ spec: document, pace: "moving" });
    const timer = setTimeout(() => followed.ask({ spec: document, pace: "resting" }), REST_MS);
    return () => clearTimeout(timer);
  });
}

interface Asked {
  readonly spec: SpecDocument;
  readonly pace: Pace;
}

async function fetchLookup(asked: Asked): Promise<Lookup> {
  const [first, ...smaller] = SIZES[asked.pace];
  return smaller.reduce((made, size) => made.catch(orSmaller(asked, size)), lookupOf(asked, first));
}

/** What takes the service long at one size is asked for at the next. */
function orSmaller(asked: Asked, size: Size): (refusal: unknown) => Promise<Lookup> {
  return (refusal) => {
    if (!takesLong(refusal)) throw refusal;
    return lookupOf(asked, size);
  };
}

async function lookupOf({ spec: document, pace }: Asked, size: Size): Promise<Lookup> {
  const table = await addTable(lookupSpec(document, size));
  const [reflectance, transmittance] = await Promise.all([texture(table.links.exr), texture(table.links["exr-transmission"])]);
  if (!reflectance) throw new Error("expected a link to the lookup texture, found none");
  return { reflectance, ...(transmittance ? { transmittance } : {}), table, size, pace, spec: document };
}

async function texture(link: string | undefined): Promise<LookupTexture | undefined> {
  if (link === undefined) return undefined;
  // three is loaded while the service computes: nobody waits for one and then for the other.
  const [{ parseLookupTexture }, bytes] = await Promise.all([import("@nacreous/three"), file(link)]);
  return parseLookupTexture(bytes);
}
