/** Tables and files that take longer than an answer may: a job makes them, and says how far it is. */

import type { JobAccepted, JobAnswer, TableAdded } from "./answers";
import { ProblemError } from "./problem";
import { ACCEPTED, answered, relative } from "./service";
import type { SpecDocument } from "../film/document";

const ENDED = new Set(["done", "failed", "cancelled"]);

/** How far a job is. */
export type JobProgress = Omit<JobAnswer, "tables">;
export type Progress = (job: JobProgress) => void;

/** A table, at once or by a job. @throws ProblemError, LostError */
export async function tabulated(spec: SpecDocument, progress: Progress, signal?: AbortSignal): Promise<TableAdded> {
  const init = { method: "POST", body: JSON.stringify(spec), headers: { "Content-Type": "application/json" } };
  const response = await answered("v1/tables", init, signal);
  if (response.status !== ACCEPTED) return response.json();
  const { table = "" } = await ended(response, progress, signal);
  return (await answered(relative(table), {}, signal)).json();
}

/** A file, at once or by a job. @throws ProblemError, LostError */
export async function made(link: string, progress: Progress, signal?: AbortSignal): Promise<Response> {
  const response = await answered(relative(link), {}, signal);
  if (response.status !== ACCEPTED) return response;
  await ended(response, progress, signal);
  return answered(relative(link), {}, signal);
}

/** Follow a job to its end, and return the links that came with it. */
async function ended(accepted: Response, progress: Progress, signal?: AbortSignal): Promise<Record<string, string>> {
  const { job, links }: JobAccepted = await accepted.json();
  let last: JobProgress = job;
  while (!ENDED.has(last.state)) {
    const events = await answered(relative(`${links["job"]}/events`), {}, signal);
    for await (const now of progressOf(events)) progress((last = now));
  }
  const failure = last.failures[0]?.message ?? last.error;
  if (last.state !== "done" || failure) throw new ProblemError(problemOfJob(failure ?? `the job was ${last.state}`));
  return links;
}

/** Server-sent events: lines of `data:`, and comments that keep the connection. */
async function* progressOf({ body }: Response): AsyncGenerator<JobProgress> {
  const reader = body?.pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  for (let part = await reader?.read(); part && !part.done; part = await reader?.read()) {
    const lines = (rest + part.value).split("\n");
    rest = lines.pop() ?? "";
    for (const line of lines) if (line.startsWith("data: ")) yield JSON.parse(line.slice("data: ".length));
  }
}

function problemOfJob(detail: string) {
  return { type: "urn:nacreous:problem:job", title: "The job has not made it", status: 500, detail };
}
