/** The film: from the incident medium inwards, to the substrate. */

import { useId } from "preact/hooks";

import { FieldMessage, refusalWords } from "./field-message";
import { FilmSection, MaterialKey } from "./film-section";
import { GroupRow } from "./group-row";
import { Icon } from "./icon";
import { LayerRow } from "./layer-row";
import { MaterialField } from "./material-field";
import { stackNews } from "./row-focus";
import { filmHeading } from "./skip-to-film";
import { addLayer, type Entry, isGroup, type Medium, setMedium } from "../film/document";
import { described } from "../film/material";
import type { Layer } from "../service/answers";
import { edit, spec } from "../state/editor";
import { problemAt } from "../state/problems";
import "./layers.css";

const NEW_LAYER: Layer = { material: { n: 1.5 }, thickness_nm: 100 };

export function Layers() {
  const id = useId();
  const { layers } = spec.value.stack;
  const ofStack = problemAt("stack.layers");
  const message = ofStack?.field === "stack.layers" ? refusalWords(ofStack) : undefined;
  return (
    <section class="layers" aria-labelledby={id}>
      <h2 id={id} ref={filmHeading} tabIndex={-1}>Film</h2>
      <FilmSection />
      <MediumRow medium="incident" label="Seen through" />
      <ol class="stack" aria-label="Layers, from where the light comes inwards">
        {layers.map((entry, at) => <StackEntry key={at} entry={entry} at={at} layers={layers} />)}
      </ol>
      <button type="button" class="add-layer" onClick={() => edit(addLayer(layers.length, NEW_LAYER))}>
        <Icon name="add" /> Add a layer
      </button>
      <FieldMessage id={`${id}-message`} message={message} />
      <MediumRow medium="substrate" label="Substrate" />
      <p class="unseen" role="status">{stackNews.value}</p>
    </section>
  );
}

interface StackEntryProps {
  readonly entry: Entry;
  readonly at: number;
  readonly layers: readonly Entry[];
}

function StackEntry({ entry, at, layers }: StackEntryProps) {
  const ends = { isFirst: at === 0, isLast: at === layers.length - 1 };
  if (isGroup(entry)) return <GroupRow group={entry} at={at} {...ends} />;
  const before = layers[at - 1];
  const grouping = before && isGroup(before) ? "add to the group above" : "make a group";
  return <LayerRow layer={entry} place={{ entry: at }} grouping={grouping} {...ends} />;
}

function MediumRow({ medium, label }: { readonly medium: Medium; readonly label: string }) {
  const material = spec.value.stack[medium];
  return (
    <div class="medium-row">
      <div class="row-head">
        <h3 class="row-name">{label}</h3>
      </div>
      <div class="row-material">
        <MaterialKey material={described(material)} />
        <MaterialField
          label={medium === "incident" ? "Incident medium" : "Substrate"}
          path={`stack.${medium}`}
          material={material}
          onMaterial={(chosen, gesture) => edit(setMedium(medium, chosen), gesture)}
        />
      </div>
    </div>
  );
}
