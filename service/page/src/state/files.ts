/** The table of the whole spec, made when somebody wants its files. */

import { computed, signal } from "@preact/signals";

import { loseConnection } from "./connection";
import { spec } from "./editor";
import type { SpecDocument } from "../film/document";
import type { TableAdded } from "../service/answers";
import { type JobProgress, tabulated } from "../service/jobs";
import { LostError, type Problem, ProblemError } from "../service/problem";

/** How far the making is. */
export interface Making {
  readonly spec: SpecDocument;
  readonly table?: TableAdded;
  readonly job?: JobProgress;
  readonly problem?: Problem;
  readonly pending: boolean;
}

export const making = signal<Making | undefined>(undefined);
/** Whether what has been made is of the film that is on the page now. */
export const isCurrent = computed(() => making.value?.spec === spec.value);

/** Tabulate the spec as it is now; what is under way for an older one is left. */
export async function makeFiles(): Promise<void> {
  const document = spec.value;
  const tell = (made: Omit<Making, "spec">) => {
    if (making.value?.spec === document) making.value = { spec: document, ...made };
  };
  making.value = { spec: document, pending: true };
  try {
    tell({ table: await tabulated(document, (job) => tell({ job, pending: true })), pending: false });
  } catch (error) {
    tell({ problem: told(error), pending: false });
  }
}

/** What went wrong, as the panel shows it. */
export function told(error: unknown): Problem {
  if (error instanceof ProblemError) return error.problem;
  if (!(error instanceof LostError)) throw error;
  loseConnection();
  return { type: "about:blank", title: "No answer", status: 503, detail: "The service does not answer", remedy: "try again once it is back" };
}
