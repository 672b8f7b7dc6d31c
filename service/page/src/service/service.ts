/** The requests of the page, one function each. All of them go to where the page itself has come from. */

import type { MaterialAnswer, MaterialList, PresetAnswer, PresetEntry, TableAdded } from "./answers";
import { bearerKey, key, refuseKey } from "./key";
import { LostError, type Problem, ProblemError } from "./problem";
import type { SpecDocument } from "../film/document";

const UNAVAILABLE = new Set([429, 503]);
const UNAUTHORIZED = 401;
const MOST_RETRIES = 4;
export const ACCEPTED = 202;
const TAKES_LONG = {
  detail: "A table as fine as this takes the service too long to follow the film live",
  expected: null,
  remedy: "its files can still be made; several layers of uneven thickness cost the most",
};

/** Tabulate a spec at once; what takes longer is not begun, see `takesLong`. @throws ProblemError, LostError */
export async function addTable(spec: SpecDocument, signal?: AbortSignal): Promise<TableAdded> {
  const init = { method: "POST", body: JSON.stringify(spec), headers: { "Content-Type": "application/json" } };
  const response = await answered("v1/tables?long=refuse", init, signal).catch(inWords);
  return response.json();
}

/** The page does not know of requests and jobs. */
function inWords(error: unknown): never {
  throw takesLong(error) ? new ProblemError({ ...error.problem, ...TAKES_LONG }) : error;
}

/** Whether a table was refused because a job would have to make it. */
export function takesLong(error: unknown): error is ProblemError {
  return error instanceof ProblemError && error.problem.field === "table";
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

/** The answer to a request; asked again where the service is busy, or its key is an old one. @throws ProblemError, LostError */
export async function answered(address: string, init: RequestInit = {}, signal?: AbortSignal): Promise<Response> {
  for (let retry = 0; ; retry++) {
    const used = key.value;
    const response = await sent(address, init, signal);
    if (response.ok) return response;
    if (response.status === UNAUTHORIZED && !refuseKey(used)) continue;
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
