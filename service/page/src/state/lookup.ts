/** The film's lookup textures: coarse ones while the spec changes, fine ones when it rests. */

import { effect } from "@preact/signals";
import type { LookupTexture } from "@nacreous/three";

import { returns } from "./connection";
import { follower } from "./asking";
import { spec } from "./editor";
import type { SpecDocument } from "../film/document";
import { COARSE, FINE, lookupSpec, type Size } from "../film/views";
import type { TableAdded } from "../service/answers";
import { made, tabulated } from "../service/jobs";

const REST_MS = 200;

/** The colours of the film, and of what it lets through. */
export interface Lookup {
  readonly reflectance: LookupTexture;
  readonly transmittance?: LookupTexture;
  readonly table: TableAdded;
  readonly size: Size;
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
    followed.ask({ spec: document, size: COARSE });
    const timer = setTimeout(() => followed.ask({ spec: document, size: FINE }), REST_MS);
    return () => clearTimeout(timer);
  });
}

interface Asked {
  readonly spec: SpecDocument;
  readonly size: Size;
}

async function fetchLookup({ spec: document, size }: Asked): Promise<Lookup> {
  const table = await tabulated(lookupSpec(document, size), unwatched);
  const [reflectance, transmittance] = await Promise.all([texture(table.links.exr), texture(table.links["exr-transmission"])]);
  if (!reflectance) throw new Error("expected a link to the lookup texture, found none");
  return { reflectance, ...(transmittance ? { transmittance } : {}), table, size, spec: document };
}

/** A job's progress, of which the page says nothing: the last colours stay until the next are there. */
function unwatched(): void {}

async function texture(link: string | undefined): Promise<LookupTexture | undefined> {
  if (link === undefined) return undefined;
  // three is loaded while the service computes: nobody waits for one and then for the other.
  const [{ parseLookupTexture }, response] = await Promise.all([import("@nacreous/three"), made(link, unwatched)]);
  return parseLookupTexture(await response.arrayBuffer());
}
