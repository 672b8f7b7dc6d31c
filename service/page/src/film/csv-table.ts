/** A table of the service as csv: comments, a line of names, and a row for each sample. */

export type Columns = Readonly<Record<string, readonly number[]>>;

/** @throws Error if a row is not as long as the line of names. */
export function parseCsv(text: string): Columns {
  const [names, ...rows] = text
    .split("\n")
    .filter((line) => line && !line.startsWith("#"))
    .map((line) => line.trimEnd().split(","));
  if (!names) throw new Error("expected a csv with a line of names, got none");
  const columns: Record<string, number[]> = Object.fromEntries(names.map((name) => [name, []]));
  for (const row of rows) {
    if (row.length !== names.length) throw new Error(`expected rows of ${names.length} values, got ${row.length}`);
    names.forEach((name, at) => columns[name]?.push(Number(row[at])));
  }
  return columns;
}

/** @throws Error if there is no such column. */
export function column(columns: Columns, name: string): readonly number[] {
  const found = columns[name];
  if (!found) throw new Error(`expected a column ${name}, got ${Object.keys(columns).join(", ")}`);
  return found;
}
