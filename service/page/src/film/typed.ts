/** What has been typed into a field for numbers. */

const DECIMAL = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/** The number that a text says, with a point or a comma; nothing where it says none. */
export function typedNumber(text: string): number | undefined {
  const trimmed = text.trim().replace(",", ".");
  if (!DECIMAL.test(trimmed)) return undefined;
  const value = Number(trimmed);
  return Number.isFinite(value) ? value : undefined;
}

/** A number as a field shows it: all of its digits that are not rounding; a very large one with its power of ten. */
export function fieldText(value: number): string {
  const rounded = Number(value.toPrecision(10));
  return rounded >= 1e7 ? rounded.toExponential().replace("+", "") : String(rounded);
}

const LONGEST_QUOTED = 40;

/** What was typed, in quotes, as a message repeats it. */
export function quoted(text: string): string {
  return text.length > LONGEST_QUOTED ? `'${text.slice(0, LONGEST_QUOTED)}…'` : `'${text}'`;
}
