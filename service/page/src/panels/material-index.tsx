/** The n and k of a material of the library, drawn, and whose numbers they are. */

import { useEffect, useState } from "preact/hooks";

import type { Material } from "../film/document";
import { nameOf } from "../film/material";
import { IndexPlot } from "../plots/index-plot";
import type { MaterialAnswer } from "../service/answers";
import { LostError, ProblemError } from "../service/problem";
import { material as askMaterial } from "../service/service";

export function MaterialIndex({ material }: { readonly material: Material }) {
  const answer = useMaterial(nameOf(material));
  if (!answer) return null;
  return (
    <div class="material-index">
      <IndexPlot samples={answer.samples} />
      {answer.description && <p>{answer.description}</p>}
      <p class="quiet">{answer.citation}</p>
    </div>
  );
}

/** The last material stays until the next one is there. */
function useMaterial(name: string): MaterialAnswer | undefined {
  const [answer, setAnswer] = useState<MaterialAnswer>();
  useEffect(() => {
    const stopped = new AbortController();
    if (name) askMaterial(name, stopped.signal).then(setAnswer).catch((error: unknown) => ignored(error, stopped.signal));
    return () => stopped.abort();
  }, [name]);
  return name ? answer : undefined;
}

/** What is wrong with the name, or with the connection, is said where the film is asked for. */
function ignored(error: unknown, { aborted }: AbortSignal): void {
  if (aborted || error instanceof ProblemError || error instanceof LostError) return;
  throw error;
}
