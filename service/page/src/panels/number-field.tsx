/** A number with its unit. What is typed stays as it was typed, also where it is no number. */

import { useId, useState } from "preact/hooks";

import { FieldMessage, invalid, refusalWords } from "./field-message";
import { fieldText, quoted, typedNumber } from "../film/typed";
import { endGesture } from "../state/editor";
import { problemAt } from "../state/problems";

/** Steps of an arrow key with Shift. */
const WIDE = 10;

export interface NumberFieldProps {
  readonly label: string;
  readonly value: number;
  /** What is expected, such as "a thickness in nanometres". */
  readonly expected: string;
  /** Of one press of an arrow key. */
  readonly step: number;
  readonly unit?: string;
  /** Path of the field in the spec, as a refusal names it. */
  readonly path: string;
  /** The label is read out, and not seen. */
  readonly labelled?: "visibly" | "unseen";
  /** Change the spec: at every key, so that one sees what one types. */
  readonly onValue: (value: number) => void;
}

/** A text, and the value that stood in the spec when it was typed: another value replaces it. */
interface Typed {
  readonly text: string;
  readonly value: number;
  /** Whether it has been left, and may be called wrong. */
  readonly left: boolean;
}

export function NumberField({ label, value, expected, step, unit, path, labelled = "visibly", onValue }: NumberFieldProps) {
  const id = useId();
  const [typed, setTyped] = useState<Typed>();
  const current = typed?.value === value ? typed : undefined;
  const isNonsense = current !== undefined && typedNumber(current.text) === undefined;
  const nonsense = isNonsense && current.left ? `Expected ${expected}, got ${quoted(current.text)}.` : undefined;
  const message = nonsense ?? refusalWords(problemAt(path));
  const type = (text: string) => {
    const number = typedNumber(text);
    setTyped({ text, value: number ?? value, left: false });
    if (number !== undefined) onValue(number);
  };
  const leave = () => {
    setTyped(isNonsense ? { ...current, left: true } : undefined);
    endGesture();
  };
  return (
    <>
      <span class="number-field">
        <label for={id} class={labelled === "unseen" ? "unseen" : ""}>{label}</label>
        <input
          id={id}
          type="text"
          inputMode="decimal"
          autocomplete="off"
          value={current?.text ?? fieldText(value)}
          {...invalid(`${id}-message`, message)}
          onInput={({ currentTarget }) => type(currentTarget.value)}
          onBlur={leave}
          onKeyDown={(event) => {
            if (event.key === "Enter") return leave();
            const direction = { ArrowUp: 1, ArrowDown: -1 }[event.key];
            if (direction === undefined) return;
            event.preventDefault();
            setTyped(undefined);
            onValue(stepped(value, direction * step * (event.shiftKey ? WIDE : 1)));
          }}
        />
        {unit && <span class="unit">{unit}</span>}
      </span>
      <FieldMessage id={`${id}-message`} message={message} />
    </>
  );
}

/** Never below 0, which no number of a film is. */
function stepped(value: number, by: number): number {
  return Math.max(Number((value + by).toPrecision(10)), 0);
}
