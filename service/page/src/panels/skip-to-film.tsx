/** The first thing that a keyboard finds: past the presets to the film. A link would be one: the fragment is the film. */

import { createRef } from "preact";

import "./skip-to-film.css";

/** Where the film begins. */
export const filmHeading = createRef<HTMLHeadingElement>();

export function SkipToFilm() {
  return (
    <button type="button" class="skip-to-film" onClick={() => filmHeading.current?.focus()}>
      Skip to the film
    </button>
  );
}
