/** The film's name, the way back, and where one is. */

import { useEffect, useState } from "preact/hooks";

import { Icon } from "./icon";
import { setName } from "../film/document";
import { LostError } from "../service/problem";
import { serviceVersion } from "../service/service";
import { lost, returns } from "../state/connection";
import { canRedo, canUndo, edit, endGesture, redo, spec, undo } from "../state/editor";
import { THEME_CHOICES, type ThemeChoice, themeChoice } from "../state/theme";
import "./header.css";

const THEME_WORDS: Record<ThemeChoice, string> = { system: "System", light: "Light", dark: "Dark" };

export function Header() {
  useEffect(followUndoKeys, []);
  return (
    <header class="header">
      <h1>Nacreous</h1>
      <FilmName />
      <Steps />
      <ThemeSwitch />
      <ServiceState />
    </header>
  );
}

function FilmName() {
  return (
    <input
      class="film-name"
      type="text"
      aria-label="Name of the film"
      placeholder="Film without a name"
      maxLength={2000}
      spellcheck={false}
      value={spec.value.name ?? ""}
      onInput={({ currentTarget }) => edit(setName(currentTarget.value), "name")}
      onBlur={endGesture}
    />
  );
}

function Steps() {
  return (
    <div class="steps">
      <button type="button" class="icon" title="Undo (Ctrl+Z)" aria-label="Undo" disabled={!canUndo.value} onClick={undo}>
        <Icon name="undo" />
      </button>
      <button type="button" class="icon" title="Redo (Ctrl+Shift+Z)" aria-label="Redo" disabled={!canRedo.value} onClick={redo}>
        <Icon name="redo" />
      </button>
    </div>
  );
}

function ThemeSwitch() {
  return (
    <select
      aria-label="Light or dark"
      value={themeChoice.value}
      onChange={({ currentTarget }) => (themeChoice.value = currentTarget.value as ThemeChoice)}
    >
      {THEME_CHOICES.map((name) => <option key={name} value={name}>{THEME_WORDS[name]}</option>)}
    </select>
  );
}

function ServiceState() {
  const [version, setVersion] = useState("");
  const asked = returns.value;
  useEffect(() => void serviceVersion().then(setVersion).catch(ignoreLost), [asked]);
  return (
    <p class="service-state">
      <a href="docs">Docs</a>
      {version && <span class="version">Version {version}</span>}
      <span>{lost.value ? "Not connected" : "Connected"}</span>
    </p>
  );
}

/** Whoever asks for a table finds that out as well, and says so. */
function ignoreLost(error: unknown): void {
  if (!(error instanceof LostError)) throw error;
}

function followUndoKeys(): () => void {
  const pressed = (event: KeyboardEvent) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const way = event.key.toLowerCase() === "z" ? (event.shiftKey ? redo : undo) : event.key === "y" ? redo : undefined;
    if (!way || hasOwnUndo(event.target)) return;
    event.preventDefault();
    way();
  };
  addEventListener("keydown", pressed);
  return () => removeEventListener("keydown", pressed);
}

/** A text that is being written, and is not yet part of the film, is undone by the browser. */
function hasOwnUndo(target: EventTarget | null): boolean {
  return target instanceof HTMLElement && target.matches("textarea, [role=combobox], [type=password]");
}
