/** A file of the table: taken with one press, checked, and said what it is. */

import { useState } from "preact/hooks";

import { Refusal } from "./refusal";
import { bytes, percent } from "../film/numbers";
import type { Problem } from "../service/problem";
import { relative } from "../service/service";
import { told } from "../state/files";
import { type Arriving, takeFile, type TakenFile } from "../state/taken-file";

interface FileRowProps {
  readonly link: string;
  readonly name: string;
  readonly holds: string;
}

export function FileRow({ link, name, holds }: FileRowProps) {
  const [arriving, setArriving] = useState<Arriving>();
  const [taken, setTaken] = useState<TakenFile>();
  const [problem, setProblem] = useState<Problem>();
  const take = async () => {
    setProblem(undefined);
    setArriving({});
    try {
      setTaken(await takeFile(link, name, setArriving));
    } catch (error) {
      setProblem(told(error));
    }
    setArriving(undefined);
  };
  return (
    <li class="file-row">
      <button type="button" disabled={arriving !== undefined} onClick={() => void take()}>
        Download {name}
      </button>
      <span class="holds">{holds}</span>
      <p role="status">{arriving ? progressWords(arriving) : taken ? <Facts link={link} taken={taken} /> : ""}</p>
      {problem && <Refusal problem={problem} />}
    </li>
  );
}

function progressWords({ job, bytes: arrived }: Arriving): string {
  if (arrived !== undefined) return `${bytes(arrived)} have come`;
  return job ? `Being made: ${percent(job.fraction)}` : "Being made";
}

function Facts({ link, taken: { bytes: count, sha256, isWhole } }: { readonly link: string; readonly taken: TakenFile }) {
  const checked = isWhole === undefined ? "" : isWhole ? ", and it is what came" : ". What came is something else: it has not been saved";
  return (
    <>
      {bytes(count)}. SHA-256 <code>{sha256}</code>
      {checked}. <a href={relative(link)}>Its address</a> stays valid.
    </>
  );
}
