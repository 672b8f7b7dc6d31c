/** What all plots have: a title, a place of their own, and words for what is missing. */

import type { ComponentChildren } from "preact";
import { useId } from "preact/hooks";

import type { Asking } from "../state/asking";
import "./plot.css";

interface PlotProps {
  readonly title: string;
  readonly class?: string;
  readonly children: ComponentChildren;
}

export function Plot({ title, class: name = "", children }: PlotProps) {
  const id = useId();
  return (
    <section class={`plot ${name}`} aria-labelledby={id}>
      <h2 id={id}>{title}</h2>
      {children}
    </section>
  );
}

/** Why there is nothing to see, or something older; nothing where all is well. */
export function PlotState({ asking, waiting }: { readonly asking: Asking<unknown>; readonly waiting: string }) {
  const { answer, problem, pending } = asking;
  if (problem) {
    const said = answer === undefined ? "Nothing to draw yet" : "What is drawn came before";
    return <p class="plot-state" role="status">{`${said}. ${problem.detail}.`}</p>;
  }
  if (answer === undefined) return <p class="plot-state" role="status">{pending ? waiting : ""}</p>;
  return null;
}

interface NumbersProps {
  readonly caption: string;
  readonly heads: readonly string[];
  readonly rows: readonly (readonly string[])[];
}

/** The numbers of a plot, folded: for those who do not see it, and for those who want to know. */
export function Numbers({ caption, heads, rows }: NumbersProps) {
  return (
    <details class="plot-numbers">
      <summary>Numbers</summary>
      <div class="plot-table" tabIndex={0} role="region" aria-label={caption}>
        <table>
          <caption>{caption}</caption>
          <thead>
            <tr>{heads.map((head) => <th scope="col" key={head}>{head}</th>)}</tr>
          </thead>
          <tbody>
            {rows.map(([first, ...others]) => (
              <tr key={first}>
                <th scope="row">{first}</th>
                {others.map((value, at) => <td key={at}>{value}</td>)}
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </details>
  );
}
