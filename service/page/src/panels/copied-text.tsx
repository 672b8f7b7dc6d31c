/** A text to take along: shown as it is, with a button that copies it. */

import { useRef, useState } from "preact/hooks";

import "./copied-text.css";

interface CopiedTextProps {
  /** What it is, such as "curl command". */
  readonly name: string;
  readonly text: string;
}

export function CopiedText({ name, text }: CopiedTextProps) {
  const shown = useRef<HTMLElement>(null);
  const [copied, setCopied] = useState("");
  const copy = async () => {
    await navigator.clipboard?.writeText(text).catch(() => undefined);
    if (!navigator.clipboard && shown.current) selectAll(shown.current);
    setCopied(text);
  };
  const said = copied !== text ? "" : navigator.clipboard ? "Copied" : "Selected: press Ctrl+C";
  return (
    <figure class="copied-text">
      <pre tabIndex={0} role="region" aria-label={name}>
        <code ref={shown}>{text}</code>
      </pre>
      <button type="button" onClick={() => void copy()} aria-label={`Copy ${name}`}>
        Copy
      </button>
      <span role="status">{said}</span>
    </figure>
  );
}

/** Pages that came over plain http have no clipboard: the reader's own keys do it. */
function selectAll(element: HTMLElement): void {
  getSelection()?.selectAllChildren(element);
}
