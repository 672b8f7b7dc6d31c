/** One axis of a lookup texture: what `nacreous:axis.x` or `nacreous:axis.y` says. */
export interface Axis {
  readonly name: string;
  readonly unit: string;
  readonly range: readonly [number, number];
  /** How many samples the axis has. */
  readonly count: number;
  /** `linear`: samples at equal steps over `range`; `explicit`: samples at `values`. */
  readonly mapping: "linear" | "explicit";
  readonly values?: readonly number[];
}

/**
 * Read an axis from the text of its attribute.
 *
 * @throws Error if the text is not an axis.
 */
export function parseAxis(attribute: string, text: string): Axis {
  const axis: unknown = JSON.parse(text);
  if (isAxis(axis)) return axis;
  throw new Error(`${attribute}: expected an axis with name, range, count and mapping, found ${text}`);
}

function isAxis(axis: unknown): axis is Axis {
  const { name, range, count, mapping, values } = (axis ?? {}) as Partial<Record<keyof Axis, unknown>>;
  const regular = typeof name === "string" && isNumbers(range) && range.length === 2 && Number.isInteger(count);
  return regular && (mapping === "linear" || (mapping === "explicit" && isNumbers(values)));
}

function isNumbers(values: unknown): values is number[] {
  return Array.isArray(values) && values.every(Number.isFinite);
}
