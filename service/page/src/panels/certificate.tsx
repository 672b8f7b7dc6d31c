/** What the table's numbers are worth, in plain words. */

import { useId } from "preact/hooks";

import { certificateSentences, numbersOf, type Certificate as Figures } from "../film/certificate";
import { isCurrent, making } from "../state/files";
import { lookup } from "../state/lookup";
import "./certificate.css";

export function Certificate() {
  const id = useId();
  const preview = lookup.value.answer;
  const files = isCurrent.value ? making.value?.table : undefined;
  return (
    <section class="certificate" aria-labelledby={id}>
      <h2 id={id}>How exact it is</h2>
      {files ? (
        <Sentences of="Of the table in your files" table={files.id} figures={files.certificate} />
      ) : (
        preview && (
          <Sentences
            of={`Of the preview's table, ${preview.size.cosTheta} angles by ${preview.size.scales} thicknesses`}
            table={preview.table.id}
            figures={preview.table.certificate}
          />
        )
      )}
      {!files && <p class="quiet">The files have a table of their own, with its own certificate.</p>}
    </section>
  );
}

interface SentencesProps {
  readonly of: string;
  readonly table: string;
  readonly figures: Figures;
}

function Sentences({ of, table, figures }: SentencesProps) {
  const [first, ...others] = certificateSentences(figures);
  return (
    <div data-table={table}>
      <p class="quiet">{of}:</p>
      <p class="certificate-first">{first}</p>
      <ul>{others.map((sentence) => <li key={sentence}>{sentence}</li>)}</ul>
      <details>
        <summary>Figures</summary>
        <dl>
          {Object.entries(numbersOf(figures)).map(([name, value]) => (
            <div key={name}>
              <dt>{name}</dt>
              <dd>{value}</dd>
            </div>
          ))}
        </dl>
      </details>
    </div>
  );
}
