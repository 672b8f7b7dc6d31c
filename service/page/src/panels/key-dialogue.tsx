/** The service asks for a key: it is kept for this tab, and all that was wanted is asked anew. */

import { useEffect, useId, useRef } from "preact/hooks";

import { FieldMessage, invalid } from "./field-message";
import { key, keyWanted, useKey } from "../service/key";
import { returns } from "../state/connection";

/** No header holds another letter: a request with such a key would never leave the browser. */
const SENDABLE = "\\s*[ -~]+\\s*";

export function KeyDialogue() {
  const id = useId();
  const dialogue = useRef<HTMLDialogElement>(null);
  const field = useRef<HTMLInputElement>(null);
  const isWanted = keyWanted.value;
  useEffect(() => (isWanted ? dialogue.current?.showModal() : dialogue.current?.close()), [isWanted]);
  const message = key.value ? "The service does not know this key." : undefined;
  const give = (event: Event) => {
    event.preventDefault();
    useKey(field.current?.value.trim() ?? "");
    returns.value++;
  };
  return (
    <dialog ref={dialogue} class="key-dialogue" aria-labelledby={`${id}-title`} onCancel={(event) => event.preventDefault()}>
      <form onSubmit={give}>
        <h2 id={`${id}-title`}>This service asks for a key</h2>
        <p class="quiet">Whoever runs it hands them out. It is kept in this tab alone.</p>
        <label>
          Key
          <input
            ref={field}
            type="password"
            autocomplete="off"
            required
            pattern={SENDABLE}
            title="Letters, digits and signs of ASCII"
            {...invalid(`${id}-message`, message)}
          />
        </label>
        <FieldMessage id={`${id}-message`} message={message} />
        <button type="submit" class="primary">Use this key</button>
      </form>
    </dialog>
  );
}
