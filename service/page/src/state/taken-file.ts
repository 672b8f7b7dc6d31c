/** A file on its way from the service to the disk of whoever looks. */

import { made, type JobProgress } from "../service/jobs";

/** A file that has arrived. */
export interface TakenFile {
  readonly bytes: number;
  /** What the service states, in hex. */
  readonly sha256: string;
  /** Whether what came is what was stated; undefined where the browser cannot tell. */
  readonly isWhole?: boolean;
}

export interface Arriving {
  readonly job?: JobProgress;
  readonly bytes?: number;
}

/** Get a file, check it against its SHA-256, and save it under a name. @throws ProblemError, LostError */
export async function takeFile(link: string, name: string, tell: (arriving: Arriving) => void): Promise<TakenFile> {
  const response = await made(link, (job) => tell({ job }));
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let bytes = 0;
  const reader = response.body?.getReader();
  for (let part = await reader?.read(); part && !part.done; part = await reader?.read()) {
    parts.push(part.value);
    tell({ bytes: (bytes += part.value.length) });
  }
  const file = new Blob(parts, { type: response.headers.get("Content-Type") ?? "" });
  const sha256 = /^(?:W\/)?"([0-9a-f]{64})/.exec(response.headers.get("ETag") ?? "")?.[1] ?? "";
  const found = await digest(file);
  if (found === undefined || found === sha256) saveFile(file, name);
  return { bytes, sha256, ...(found === undefined ? {} : { isWhole: found === sha256 }) };
}

export function saveFile(file: Blob, name: string): void {
  const address = URL.createObjectURL(file);
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), LONGEST_START_MS);
}

/** Within which a browser has begun to save. */
const LONGEST_START_MS = 60_000;

/** SHA-256 in hex; undefined on pages that came over plain http from elsewhere, where browsers have none. */
async function digest(file: Blob): Promise<string | undefined> {
  if (!crypto.subtle) return undefined;
  const hash = new Uint8Array(await crypto.subtle.digest("SHA-256", await file.arrayBuffer()));
  return Array.from(hash, (byte) => byte.toString(16).padStart(2, "0")).join("");
}
