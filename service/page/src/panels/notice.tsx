/** What is wrong with the page as a whole: no service, no key, a refusal that belongs to no field. */

import { refusalWords } from "./field-message";
import { KeyDialogue } from "./key-dialogue";
import type { Problem } from "../service/problem";
import { lost, returns } from "../state/connection";
import { hasPlace, problems } from "../state/problems";
import "./notice.css";

export function Notice() {
  const placeless = problems.value.filter((problem) => !hasPlace(problem));
  return (
    <div class="notice">
      <div role="status">
        {lost.value && (
          <p class="notice-lost">The service does not answer. Your film is kept; trying again until it does.</p>
        )}
      </div>
      <div role="alert">
        {placeless.map((problem) => <Refused key={problem.detail} problem={problem} />)}
      </div>
      <KeyDialogue />
    </div>
  );
}

/** Of a spec that is wrong: it would be refused again. */
const UNPROCESSABLE = 422;

function Refused({ problem }: { readonly problem: Problem }) {
  return (
    <div class="notice-problem">
      <span>
        {problem.field && <b>{problem.field}: </b>}
        {refusalWords(problem)}
      </span>
      {!problem.field && problem.status !== UNPROCESSABLE && <button type="button" onClick={() => returns.value++}>Try again</button>}
    </div>
  );
}
