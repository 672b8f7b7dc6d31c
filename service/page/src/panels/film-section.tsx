/** The film cut open, drawn to scale: a grey for each material. What it shows is said by the rows beneath. */

import { described } from "../film/material";
import { type Band, bands, shades } from "../film/section";
import { spec } from "../state/editor";
import "./film-section.css";

/** Of a picture 100 high: the half-spaces above and below the film. */
const AROUND = 16;
const FILM = 100 - 2 * AROUND;

export function FilmSection() {
  const { stack } = spec.value;
  const shade = shades(spec.value);
  const drawn = placed(bands(spec.value));
  return (
    <svg class="film-section" viewBox="0 0 100 100" preserveAspectRatio="none" aria-hidden="true">
      <rect class={`shade-${shade(described(stack.incident))}`} width="100" height={AROUND + 1} />
      {drawn.map(({ material, top, height }, at) => (
        <rect key={at} class={`shade-${shade(material)}`} y={top} width="100" height={height} />
      ))}
      <rect class={`shade-${shade(described(stack.substrate))}`} y={100 - AROUND} width="100" height={AROUND} />
    </svg>
  );
}

/** The key of a material, beside its row. */
export function MaterialKey({ material }: { readonly material: string }) {
  return <span class={`material-key shade-${shades(spec.value)(material)}`} aria-hidden="true" />;
}

function placed(all: readonly Band[]): readonly { material: string; top: number; height: number }[] {
  let top = AROUND;
  return all.map(({ material, share }) => {
    const band = { material, top, height: share * FILM };
    top += band.height;
    return band;
  });
}
