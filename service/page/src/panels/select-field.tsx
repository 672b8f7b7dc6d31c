/** One of a few values, each in words. */

import { useId } from "preact/hooks";

interface SelectFieldProps<Value extends string> {
  readonly label: string;
  readonly value: Value;
  readonly words: Readonly<Record<Value, string>>;
  readonly isDisabled?: boolean;
  readonly onValue: (value: Value) => void;
}

export function SelectField<Value extends string>({ label, value, words, isDisabled = false, onValue }: SelectFieldProps<Value>) {
  const id = useId();
  return (
    <span class="select-field">
      <label for={id}>{label}</label>
      <select id={id} value={value} disabled={isDisabled} onChange={({ currentTarget }) => onValue(currentTarget.value as Value)}>
        {(Object.keys(words) as Value[]).map((known) => <option key={known} value={known}>{words[known]}</option>)}
      </select>
    </span>
  );
}
