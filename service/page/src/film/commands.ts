/** The same table from a command line. */

import { brief } from "./brief";
import type { SpecDocument } from "./document";

/** Ask this service for the table, by curl. */
export function curlCommand(spec: SpecDocument, service: string, hasKey: boolean): string {
  const key = hasKey ? ` -H "Authorization: Bearer $NACREOUS_SERVER_KEY"` : "";
  const { stack, surface, table, colour, accuracy } = brief(spec); // labels are no part of the table
  const body = quoted(JSON.stringify({ stack, surface, table, colour, accuracy }));
  return `curl -fsS${key} -H "Content-Type: application/json" -d ${body} ${quoted(`${service}v1/tables`)}`;
}

/** Make it on one's own machine: an unchanged preset by its name, anything else from its file. */
export function tabulateCommand(preset: string, stem: string): string {
  return preset ? `nacreous tabulate ${preset} --format exr -o .` : `nacreous tabulate ${stem}.toml --format exr -o .`;
}

/** A name for files: that of the film in plain letters. */
export function fileStem(spec: SpecDocument, preset: string): string {
  const plain = (preset || spec.name || "")
    .normalize("NFKD")
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, "-")
    .replace(/^-+|-+$/g, "")
    .slice(0, 60);
  return plain || "film";
}

/** One word for a shell, whatever is in it. */
function quoted(text: string): string {
  return `'${text.replaceAll("'", `'\\''`)}'`;
}
