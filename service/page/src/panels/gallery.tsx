/** Films to begin with, each a picture of its colours: the angle across, the thickness down. */

import { useEffect, useId } from "preact/hooks";

import { ServicePicture } from "./service-picture";
import type { PresetEntry } from "../service/answers";
import { openedPreset } from "../state/editor";
import { allPresets, followPresets, openPreset, picturesDone } from "../state/presets";
import "./gallery.css";

const PAPER = "paper/";

export function Gallery() {
  const id = useId();
  useEffect(followPresets, []);
  const films = allPresets.value.filter(({ name }) => !name.startsWith(PAPER));
  const figures = allPresets.value.filter(({ name }) => name.startsWith(PAPER));
  const current = allPresets.value.find(({ name }) => name === openedPreset.value);
  return (
    <section class="gallery" aria-labelledby={id}>
      <h2 id={id} class="unseen">Presets</h2>
      <div class="gallery-shelf">
        {films.length > 0 && <Part title="Films" presets={films} first={0} />}
        {figures.length > 0 && <Part title="Figures of the paper" presets={figures} first={films.length} />}
      </div>
      <p class="gallery-words" role="status">{current ? plain(current.description) : ""}</p>
    </section>
  );
}

interface PartProps {
  readonly title: string;
  readonly presets: readonly PresetEntry[];
  /** Place of its first picture among all of them. */
  readonly first: number;
}

function Part({ title, presets, first }: PartProps) {
  const id = useId();
  return (
    <div class="gallery-part">
      <h3 id={id}>{title}</h3>
      <ul aria-labelledby={id}>
        {presets.map((entry, at) => <Preset key={entry.name} entry={entry} at={first + at} />)}
      </ul>
    </div>
  );
}

function Preset({ entry: { name, title, description, links }, at }: { readonly entry: PresetEntry; readonly at: number }) {
  const isCurrent = openedPreset.value === name;
  return (
    <li>
      <button
        type="button"
        title={plain(description)}
        {...(isCurrent ? { "aria-current": "true" as const } : {})}
        onClick={() => void openPreset(name)}
      >
        <span class="swatch-frame">
          {links["png"] && at <= picturesDone.value && (
            <ServicePicture link={links["png"]} onSettled={() => (picturesDone.value = Math.max(picturesDone.value, at + 1))} />
          )}
        </span>
        <span class="preset-title">{title}</span>
      </button>
    </li>
  );
}

/** A description without its marks of code. */
function plain(description: string): string {
  return description.replaceAll("`", "");
}
