/** A material by name: typing searches the library, arrow keys go through what is found (ARIA 1.2, combobox). */

import { useEffect, useId, useRef, useState } from "preact/hooks";

import { invalid } from "./field-message";
import { type Found, useMaterialSearch } from "./material-search";
import { counted, nanometres } from "../film/numbers";
import type { MaterialList } from "../service/answers";
import "./material-combobox.css";

type MaterialEntry = MaterialList["materials"][number];

interface MaterialComboboxProps {
  readonly label: string;
  /** Name of the material that is chosen. */
  readonly name: string;
  readonly messageId: string;
  readonly message: string | undefined;
  readonly focused?: "at once";
  readonly onChoose: (name: string) => void;
  /** A text was left that names nothing; an empty one where that has been mended. */
  readonly onUnknown: (text: string) => void;
}

export function MaterialCombobox({ label, name, messageId, message, focused, onChoose, onUnknown }: MaterialComboboxProps) {
  const id = useId();
  const input = useRef<HTMLInputElement>(null);
  const [text, setText] = useState<string>();
  const [isOpen, setIsOpen] = useState(false);
  const [active, setActive] = useState(-1);
  const found = useMaterialSearch(isOpen ? (text ?? "").trim() : undefined);
  const options = found?.list.materials ?? [];
  useEffect(() => setText(undefined), [name]);
  useEffect(() => setActive(text ? bestOf(options, text) : -1), [found]);
  useEffect(() => void (focused && input.current?.focus()), []);
  useEffect(() => document.getElementById(`${id}-${active}`)?.scrollIntoView({ block: "nearest" }), [active]);

  const close = () => {
    setIsOpen(false);
    setActive(-1);
  };
  const choose = (entry: MaterialEntry) => {
    setText(undefined);
    onUnknown("");
    close();
    onChoose(entry.name);
  };
  const leave = () => {
    close();
    const named = options.find((entry) => entry.name === text?.trim());
    if (named) choose(named);
    else if (!text?.trim() || text.trim() === name) restore();
    else onUnknown(text);
  };
  const restore = () => {
    setText(undefined);
    onUnknown("");
  };
  const move = (by: number) => {
    if (!isOpen) setIsOpen(true);
    else if (options.length > 0) setActive((active + by + options.length + (active < 0 && by < 0 ? 1 : 0)) % options.length);
  };
  const pressed = (event: KeyboardEvent) => {
    const chosen = isOpen ? options[active] : undefined;
    const action = {
      ArrowDown: () => move(1),
      ArrowUp: () => move(-1),
      Enter: () => (chosen ? choose(chosen) : leave()),
      Escape: () => (isOpen ? close() : restore()),
    }[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  };
  return (
    <div class="combobox">
      <input
        ref={input}
        type="text"
        role="combobox"
        aria-label={label}
        aria-autocomplete="list"
        aria-expanded={isOpen}
        aria-controls={`${id}-list`}
        {...(isOpen && active >= 0 ? { "aria-activedescendant": `${id}-${active}` } : {})}
        {...invalid(messageId, message)}
        autocomplete="off"
        spellcheck={false}
        placeholder="Search a material"
        value={text ?? name}
        onFocus={({ currentTarget }) => currentTarget.select()}
        onClick={() => setIsOpen(true)}
        onInput={({ currentTarget }) => {
          setText(currentTarget.value);
          setIsOpen(true);
        }}
        onBlur={leave}
        onKeyDown={pressed}
      />
      <Popup id={id} isOpen={isOpen} found={found} active={active} onChoose={choose} />
    </div>
  );
}

/** Index of the option that Enter takes: the one of this very name, or else the first; -1 where there is none. */
function bestOf(options: readonly MaterialEntry[], text: string): number {
  const named = options.findIndex((entry) => entry.name === text.trim());
  return named >= 0 ? named : Math.min(0, options.length - 1);
}

interface PopupProps {
  readonly id: string;
  readonly isOpen: boolean;
  readonly found: Found | undefined;
  readonly active: number;
  readonly onChoose: (entry: MaterialEntry) => void;
}

function Popup({ id, isOpen, found, active, onChoose }: PopupProps) {
  return (
    // The pointer must not take the focus from the field, which would close the list.
    <div class="combobox-popup" hidden={!isOpen} onMouseDown={(event) => event.preventDefault()}>
      <ul id={`${id}-list`} role="listbox" aria-label="Materials">
        {isOpen &&
          found?.list.materials.map((entry, at) => (
            <li key={entry.name} id={`${id}-${at}`} role="option" aria-selected={at === active} onClick={() => onChoose(entry)}>
              <span class="material-name">
                <b>{entry.name}</b>
                <span class="range quiet">{rangeWords(entry.range_nm)}</span>
              </span>
              <span class="about quiet">{entry.description || entry.citation}</span>
            </li>
          ))}
      </ul>
      <p class="count quiet" role="status">{isOpen ? countWords(found) : ""}</p>
    </div>
  );
}

function rangeWords([least, most]: readonly [number, number]): string {
  return `${Math.round(least)} to ${nanometres(Math.round(most))}`;
}

function countWords(found: Found | undefined): string {
  if (!found) return "Searching.";
  const { materials, total } = found.list;
  if (total === 0) return `No material holds "${found.search}".`;
  return total > materials.length ? `${materials.length} of ${counted(total)} materials; type to find others.` : `${counted(total)} found.`;
}
