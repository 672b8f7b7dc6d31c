/** A spec as TOML, laid out as one writes it by hand: sections, a table for each layer, values in one line. */

import { brief } from "./brief";
import type { SpecDocument } from "./document";

type Section = Readonly<Record<string, unknown>>;

const SECTIONS = ["surface", "table", "colour", "accuracy"] as const;
const BARE_KEY = /^[A-Za-z0-9_-]+$/;
/** Characters of a line that an editor shows whole. */
const WIDEST_LINE = 100;

export function toToml(spec: SpecDocument): string {
  const { stack, name, description, source, ...others } = brief(spec);
  const { layers, ...media } = stack;
  const blocks = [
    fields({ name, description, source }),
    ["[stack]", ...fields({ ...media }), ...(layers.length ? [] : ["layers = []"])],
    ...layers.map((layer) => ["[[stack.layers]]", ...fields({ ...layer })]),
    ...SECTIONS.flatMap((section) => (others[section] ? [[`[${section}]`, ...fields({ ...others[section] })]] : [])),
  ];
  return `${blocks
    .filter((lines) => lines.length > 0)
    .map((lines) => lines.join("\n"))
    .join("\n\n")}\n`;
}

function fields(section: Section): string[] {
  return Object.entries(section)
    .filter(([, value]) => value !== undefined)
    .map(([name, value]) => `${key(name)} = ${broken(value, key(name).length + 3)}`);
}

/** A list that is too long for its line gets a line for each of its values. */
function broken(value: unknown, indent: number): string {
  const line = inline(value);
  const isLong = Array.isArray(value) && (line.length + indent > WIDEST_LINE || value.some(isSection));
  if (!isLong) return line;
  return value.some(isSection) ? `[\n${value.map((item) => `    ${inline(item)},\n`).join("")}]` : wrapped(value.map(inline));
}

function wrapped(items: readonly string[]): string {
  const lines = [""];
  for (const item of items) {
    const last = lines.at(-1) ?? "";
    if (last.length + item.length < WIDEST_LINE - 6) lines[lines.length - 1] = `${last}${last && " "}${item},`;
    else lines.push(`${item},`);
  }
  return `[\n${lines.map((line) => `    ${line}\n`).join("")}]`;
}

/** JSON's strings and numbers are TOML's too; its tables are not. */
function inline(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(inline).join(", ")}]`;
  if (!isSection(value)) return JSON.stringify(value);
  const pairs = Object.entries(value).map(([name, inner]) => `${key(name)} = ${inline(inner)}`);
  return `{ ${pairs.join(", ")} }`;
}

function key(name: string): string {
  return BARE_KEY.test(name) ? name : JSON.stringify(name);
}

function isSection(value: unknown): value is Section {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
