/** What is wrong with a field, beside it. */

import type { ComponentChildren } from "preact";

import type { Problem } from "../service/problem";
import "./field.css";

interface FieldMessageProps {
  /** Id that the field is described by while there is a message. */
  readonly id: string;
  readonly message: string | undefined;
  /** What mends it with a click. */
  readonly children?: ComponentChildren;
}

export function FieldMessage({ id, message, children }: FieldMessageProps) {
  return (
    <div id={id} class="field-message" aria-live="polite">
      {message && <p>{message}</p>}
      {message && children}
    </div>
  );
}

/** A refusal as a sentence: what was expected, what came, what to do. */
export function refusalWords(problem: Problem | undefined): string | undefined {
  if (!problem) return undefined;
  const { expected, got, remedy, detail } = problem;
  if (!expected) return detail;
  return `Expected ${expected}${got ? `, got ${got}` : ""}${remedy ? `; ${remedy}` : ""}.`;
}

/** How a field tells what is wrong with it. */
export function invalid(id: string, message: string | undefined) {
  return message ? { "aria-invalid": true as const, "aria-describedby": id } : {};
}
