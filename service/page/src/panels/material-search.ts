/** Materials that are searched for while one types: the newest search only, a moment after the last key. */

import { useEffect, useState } from "preact/hooks";

import { LostError, ProblemError } from "../service/problem";
import type { MaterialList } from "../service/answers";
import { materials } from "../service/service";
import { loseConnection, returns } from "../state/connection";

const REST_MS = 120;
const MOST_FOUND = 30;

export interface Found {
  /** What was searched for. */
  readonly search: string;
  readonly list: MaterialList;
}

/** The materials of a search; `undefined` searches for nothing. The last ones stay until others are there. */
export function useMaterialSearch(search: string | undefined): Found | undefined {
  const [found, setFound] = useState<Found>();
  const asked = returns.value; // asked anew when the service comes back
  useEffect(() => {
    if (search === undefined) return;
    const stopped = new AbortController();
    const timer = setTimeout(() => void find(search, stopped.signal).then((list) => list && setFound({ search, list })), REST_MS);
    return () => {
      clearTimeout(timer);
      stopped.abort();
    };
  }, [search, asked]);
  return found;
}

async function find(search: string, signal: AbortSignal): Promise<MaterialList | undefined> {
  try {
    return await materials(search, MOST_FOUND, signal);
  } catch (error) {
    if (signal.aborted || error instanceof ProblemError) return undefined;
    if (!(error instanceof LostError)) throw error;
    loseConnection();
    return undefined;
  }
}
