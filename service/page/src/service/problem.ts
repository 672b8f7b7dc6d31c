/** What can go wrong with a request: the service refuses it, or does not answer. */

import type { ProblemAnswer } from "./answers";

/** A refusal, as RFC 9457 has it, with the fields that Nacreous adds. */
export type Problem = ProblemAnswer;

/** The service has answered that it will not. */
export class ProblemError extends Error {
  override readonly name = "ProblemError";

  constructor(readonly problem: Problem) {
    super(problem.detail);
  }
}

/** The service has not answered. */
export class LostError extends Error {
  override readonly name = "LostError";
}
