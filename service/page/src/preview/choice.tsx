/** One of a few, as a row of radio buttons. */

import type { Signal } from "@preact/signals";

interface Choices<Value extends string> {
  readonly legend: string;
  readonly values: readonly Value[];
  readonly chosen: Signal<Value>;
}

export function Choice<Value extends string>({ legend, values, chosen }: Choices<Value>) {
  return (
    <fieldset class="choice">
      <legend>{legend}</legend>
      <div class="choice-row">
        {values.map((value) => (
          <label key={value}>
            <input
              type="radio"
              name={`preview-${legend}`}
              value={value}
              checked={chosen.value === value}
              onChange={() => void (chosen.value = value)}
            />
            <span>{value[0]!.toUpperCase() + value.slice(1)}</span>
          </label>
        ))}
      </div>
    </fieldset>
  );
}
