/** The lobe of the surface at the angle that is looked at; asked for while somebody looks. */

import { signal } from "@preact/signals";

import { follower } from "./asking";
import { atRest } from "./at-rest";
import { spec } from "./editor";
import { thetaDegrees } from "./view";
import type { SpecDocument } from "../film/document";
import { isRough, type LobeSample, lobeSamples, lobeSpec } from "../film/lobe";
import { addTable, text } from "../service/service";

const REST_MS = 400;

export interface Lobe {
  readonly thetaDegrees: number;
  readonly samples: readonly LobeSample[];
}

interface Asked {
  readonly spec: SpecDocument;
  readonly thetaDegrees: number;
}

/** Whether the lobe can be seen on the screen. */
export const isLobeSeen = signal(false);

const followed = follower(fetchLobe);
export const lobe = followed.state;

export function followLobe(): () => void {
  return atRest(REST_MS, wanted, followed.ask);
}

function wanted(): Asked | undefined {
  if (!isLobeSeen.value || !isRough(spec.value)) return undefined;
  return { spec: spec.value, thetaDegrees: thetaDegrees.value };
}

async function fetchLobe({ spec: document, thetaDegrees: theta }: Asked): Promise<Lobe> {
  const { links } = await addTable(lobeSpec(document, theta));
  if (!links["csv"]) throw new Error("expected a link to the lobe as csv, found none");
  return { thetaDegrees: theta, samples: lobeSamples(await text(links["csv"])) };
}
