/** The requests of the page, one function each. All of them go to where the page itself has come from. */

import type { JobAccepted, MaterialAnswer, MaterialList, PresetAnswer, PresetEntry, TableAdded } from "./answers";
import { bearerKey, keyWanted } from "./key";
import { LostError, type Problem, ProblemError } from "./problem";
import type { SpecDocument } from "../film/document";

const UNAVAILABLE = new Set([429, 503]);
const UNAUTHORIZED = 401;
const MOST_RETRIES = 4;
export const ACCEPTED = 202;

/** Tabulate a spec at once; what takes longer is not begun. @throws ProblemError, LostError */
export async function addTable(spec: SpecDocument, signal?: AbortSignal): Promise<TableAdded> {
  const body = JSON.stringify(spec);
  const response = await answered("v1/tables", { method: "POST", body, headers: { "Content-Type": "application/json" } }, signal);
  if (response.status === ACCEPTED) throw new ProblemError(await tooLong(response));
  return response.json();
}

/** A job is no way to follow a film that is being edited: it is called off. */
async function tooLong(accepted: Response): Promise<Problem> {
  const { job }: JobAccepted = await accepted.json();
  await answered(`v1/jobs/${job.id}`, { method: "DELETE" });
  const detail = "A table as fine as this takes the service too long to follow the film live";
  const remedy = "its files can still be made; several layers of uneven thickness cost the most";
  return { type: "about:blank", title: "Takes too long", status: ACCEPTED, detail, remedy };
}

/** Get a file by its link. @throws ProblemError, LostError */
export async function file(link: string, signal?: AbortSignal): Promise<ArrayBuffer> {
  return (await answered(relative(link), {}, signal)).arrayBuffer();
}

/** Get a text by its link. @throws ProblemError, LostError */
export async function text(link: string, signal?: AbortSignal): Promise<string> {
  return (await answered(relative(link), {}, signal)).text();
}

export async function presets(): Promise<PresetEntry[]> {
  return (await answered("v1/presets")).json();
}

export async function preset(name: string): Promise<PresetAnswer> {
  return (await answered(`v1/presets/${name}`)).json();
}

/** Find materials that hold every word. */
export async function materials(search: string, limit: number, signal?: AbortSignal): Promise<MaterialList> {
  const query = new URLSearchParams({ search, limit: String(limit) });
  return (await answered(`v1/materials?${query}`, {}, signal)).json();
}

export async function material(name: string, signal?: AbortSignal): Promise<MaterialAnswer> {
  return (await answered(`v1/materials/${encodeURI(name)}`, {}, signal)).json();
}

/** The version that answers. @throws LostError */
export async function serviceVersion(): Promise<string> {
  return (await (await answered("healthz")).json()).version;
}

/** Whether the service answers at all. */
export async function isAlive(): Promise<boolean> {
  try {
    return (await fetch("healthz", { cache: "no-store" })).ok;
  } catch {
    return false;
  }
}

/** The address of a link of the service, beside this page wherever that lies. */
export function relative(link: string): string {
  return link.replace(/^\//, "");
}

/** The answer to a request; asked again where the service is busy. @throws ProblemError, LostError */
export async function answered(address: string, init: RequestInit = {}, signal?: AbortSignal): Promise<Response> {
  for (let retry = 0; ; retry++) {
    const response = await sent(address, init, signal);
    if (response.ok) return response;
    if (response.status === UNAUTHORIZED) keyWanted.value = true;
    if (!UNAVAILABLE.has(response.status) || retry === MOST_RETRIES) throw new ProblemError(await problemOf(response));
    await pause(Number(response.headers.get("Retry-After") ?? 1), signal);
  }
}

async function sent(address: string, init: RequestInit, signal?: AbortSignal): Promise<Response> {
  const headers = { ...init.headers, ...bearerKey() };
  try {
    return await fetch(address, { ...init, headers, ...(signal ? { signal } : {}) });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new LostError("the service does not answer", { cause: error });
  }
}

async function problemOf(response: Response): Promise<Problem> {
  const { status, statusText: title } = response;
  const about = { type: "about:blank", title, status, detail: `${status} ${title}` };
  return response.json().catch(() => about);
}

function pause(seconds: number, signal?: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(resolve, seconds * 1000);
    signal?.addEventListener("abort", () => {
      clearTimeout(timer);
      reject(signal.reason);
    });
  });
}
