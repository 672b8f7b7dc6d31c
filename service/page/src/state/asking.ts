/** A table of the film that follows the spec: what has been answered last, and what was wrong since. */

import { signal, type ReadonlySignal } from "@preact/signals";

import { Latest } from "./latest";
import { loseConnection } from "./connection";
import { LostError, type Problem, ProblemError } from "../service/problem";

/** What is known of something asked for. The last answer stays while another is awaited, or refused. */
export interface Asking<Answer> {
  readonly answer?: Answer;
  readonly problem?: Problem;
  readonly pending: boolean;
}

export interface Follower<Asked, Answer> {
  readonly state: ReadonlySignal<Asking<Answer>>;
  ask(asked: Asked): void;
}

/** Ask for the newest only, one at a time. */
export function follower<Asked, Answer>(fetched: (asked: Asked) => Promise<Answer>): Follower<Asked, Answer> {
  const state = signal<Asking<Answer>>({ pending: false });
  const latest = new Latest<Asked>(async (asked) => {
    state.value = { ...state.value, pending: true };
    state.value = await settled(state.value, () => fetched(asked));
  });
  return { state, ask: (asked) => latest.ask(asked) };
}

async function settled<Answer>(before: Asking<Answer>, fetched: () => Promise<Answer>): Promise<Asking<Answer>> {
  const kept = before.answer === undefined ? {} : { answer: before.answer };
  try {
    return { answer: await fetched(), pending: false };
  } catch (error) {
    if (error instanceof ProblemError) return { ...kept, problem: error.problem, pending: false };
    if (!(error instanceof LostError)) throw error;
    loseConnection();
    return { ...kept, pending: false };
  }
}
