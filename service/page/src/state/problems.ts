/** What the service has refused of the film, and the field that it belongs to. */

import { computed } from "@preact/signals";

import { spec } from "./editor";
import { isCurrent, making } from "./files";
import { lobe } from "./lobe";
import { lookup } from "./lookup";
import { isRough } from "../film/lobe";
import type { Problem } from "../service/problem";

const UNAUTHORIZED = 401;

/** Every refusal that stands, each once; that of the film itself first. */
export const problems = computed<readonly Problem[]>(() => {
  const ofLobe = isRough(spec.value) ? lobe.value.problem : undefined;
  const ofFiles = isCurrent.value ? making.value?.problem : undefined;
  const all = [lookup.value.problem, ofLobe, ofFiles];
  const standing = all.filter((problem) => problem !== undefined && problem.status !== UNAUTHORIZED) as Problem[];
  return standing.filter(({ detail }, at) => standing.findIndex((other) => other.detail === detail) === at);
});

/** The refusal of this field, or of a part of it. */
export function problemAt(path: string): Problem | undefined {
  return problems.value.find(({ field }) => field === path || field?.startsWith(`${path}.`));
}

const OF_A_LAYER = "\\d+\\.(layers\\.\\d+\\.)?(material|thickness_nm|thickness_sigma_nm|repeat)\\b";
const WITH_A_PLACE = new RegExp(`^stack\\.(incident|substrate|layers$|layers\\.${OF_A_LAYER})`);

/** Whether a refusal is shown beside the field that it is about: those of the stack are always in sight. */
export function hasPlace({ field }: Problem): boolean {
  return WITH_A_PLACE.test(field ?? "");
}
