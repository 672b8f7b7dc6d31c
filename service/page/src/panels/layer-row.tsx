/** One layer: its material, its thickness, and what is less often wanted folded away. */

import { useState } from "preact/hooks";

import { MaterialKey } from "./film-section";
import { MaterialField } from "./material-field";
import { MaterialIndex } from "./material-index";
import { NumberField } from "./number-field";
import { RowActions } from "./row-actions";
import { focusRow, rowName, stackNews } from "./row-focus";
import { ThicknessSlider } from "./thickness-slider";
import {
  fieldPath,
  groupLayer,
  insertAfter,
  moveEntry,
  moveMember,
  type Place,
  removeLayer,
  setLayer,
} from "../film/document";
import { described } from "../film/material";
import type { Layer } from "../service/answers";
import { edit } from "../state/editor";

interface LayerRowProps {
  readonly layer: Layer;
  readonly place: Place;
  readonly isFirst: boolean;
  readonly isLast: boolean;
  /** What grouping it would do; nothing for a layer that is in a group. */
  readonly grouping?: "make a group" | "add to the group above";
}

export function LayerRow({ layer, place, isFirst, isLast, grouping }: LayerRowProps) {
  const name = `layer ${layerNumber(place)}`;
  const set = (fields: Partial<Layer>, gesture = "") => edit(setLayer(place, fields), gesture);
  return (
    <li class="layer-row" data-row={rowName(place)} aria-label={capital(name)}>
      <div class="row-head">
        <h3 class="row-name">{capital(name)}</h3>
        <RowActions
          name={name}
          isFirst={isFirst}
          isLast={isLast}
          onMove={(by) => move(place, by, name)}
          onRemove={() => remove(place, name)}
        />
      </div>
      <div class="row-material">
        <MaterialKey material={described(layer.material)} />
        <MaterialField
          label={`Material of ${name}`}
          path={fieldPath(place, "material")}
          material={layer.material}
          onMaterial={(material, gesture) => set({ material }, gesture)}
        />
      </div>
      <Thickness layer={layer} place={place} name={name} onThickness={(thickness_nm, gesture) => set({ thickness_nm }, gesture)} />
      <More layer={layer} place={place} name={name} grouping={grouping} onFields={set} />
    </li>
  );
}

interface ThicknessProps {
  readonly layer: Layer;
  readonly place: Place;
  readonly name: string;
  readonly onThickness: (thickness_nm: number, gesture: string) => void;
}

function Thickness({ layer: { thickness_nm }, place, name, onThickness }: ThicknessProps) {
  const path = fieldPath(place, "thickness_nm");
  return (
    <div class="row-thickness">
      <ThicknessSlider
        label={`Thickness of ${name}, slider`}
        value={thickness_nm}
        onValue={(value) => onThickness(value, `slide ${path}`)}
      />
      <NumberField
        label={`Thickness of ${name}`}
        labelled="unseen"
        value={thickness_nm}
        unit="nm"
        expected="a thickness in nanometres, 0 or 1e-6 to 1e8"
        step={1}
        path={path}
        onValue={(value) => onThickness(value, `type ${path}`)}
      />
    </div>
  );
}

interface MoreProps {
  readonly layer: Layer;
  readonly place: Place;
  readonly name: string;
  readonly grouping: LayerRowProps["grouping"];
  readonly onFields: (fields: Partial<Layer>, gesture?: string) => void;
}

function More({ layer, place, name, grouping, onFields }: MoreProps) {
  const [isOpen, setIsOpen] = useState(false);
  const path = fieldPath(place, "thickness_sigma_nm");
  const { thickness_sigma_nm = 0, coherent = true } = layer;
  return (
    <details class="more" onToggle={({ currentTarget }) => setIsOpen(currentTarget.open)}>
      <summary>
        More<span class="unseen"> of {name}</span>
        {extras(layer)}
      </summary>
      {isOpen && (
        <div class="more-fields">
          <span>
            <NumberField
              label="Varies by"
              value={thickness_sigma_nm}
              unit="nm, standard deviation"
              expected="a standard deviation in nanometres, at most a fifth of the thickness"
              step={0.5}
              path={path}
              onValue={(value) => onFields({ thickness_sigma_nm: value }, path)}
            />
          </span>
          <label>
            <input
              type="checkbox"
              checked={!coherent}
              onChange={({ currentTarget }) => onFields({ coherent: !currentTarget.checked })}
            />{" "}
            Thick layer: intensities are added, without fringes
          </label>
          <div class="more-actions">
            <button type="button" onClick={() => edit(insertAfter(place, layer))}>Duplicate</button>
            {grouping && (
              <button type="button" onClick={() => edit(groupLayer(place.entry))}>{capital(grouping)}</button>
            )}
          </div>
          <MaterialIndex material={layer.material} />
        </div>
      )}
    </details>
  );
}

/** What is set among the folded fields, so that it is not overlooked. */
function extras({ thickness_sigma_nm = 0, coherent = true }: Layer): string {
  const spread = thickness_sigma_nm > 0 ? `, varies by ${thickness_sigma_nm} nm` : "";
  return `${spread}${coherent ? "" : ", thick"}`;
}

function move(place: Place, by: -1 | 1, name: string): void {
  const { entry, member } = place;
  edit(member === undefined ? moveEntry(entry, entry + by) : moveMember(place, by));
  stackNews.value = `${capital(name)} moved ${by < 0 ? "up" : "down"}.`;
  focusRow(member === undefined ? { entry: entry + by } : { entry, member: member + by }, by < 0 ? "up" : "down");
}

function remove(place: Place, name: string): void {
  edit(removeLayer(place));
  stackNews.value = `${capital(name)} removed.`;
  focusRow(place, "remove");
}

/** As people count: from 1, in a group 2.1. */
function layerNumber({ entry, member }: Place): string {
  return member === undefined ? `${entry + 1}` : `${entry + 1}.${member + 1}`;
}

function capital(text: string): string {
  return text.slice(0, 1).toUpperCase() + text.slice(1);
}
