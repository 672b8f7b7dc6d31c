/** What the service will not do, and what to do instead. */

import type { Problem } from "../service/problem";
import "./refusal.css";

export function Refusal({ problem }: { readonly problem: Problem }) {
  const { field, expected, got, remedy, detail } = problem;
  return (
    <div class="refusal" role="alert">
      <p>{detail}</p>
      {expected && (
        <dl>
          {field && <Part name="Field" value={field} />}
          <Part name="Expected" value={expected} />
          {got && <Part name="Got" value={got} />}
        </dl>
      )}
      {remedy && <p>What to do: {remedy}.</p>}
    </div>
  );
}

function Part({ name, value }: { readonly name: string; readonly value: string }) {
  return (
    <div>
      <dt>{name}</dt>
      <dd>{value}</dd>
    </div>
  );
}
