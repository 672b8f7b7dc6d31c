/** What the downloads hold: the quantity, its samples, and how a spectrum becomes a colour. */

import { NumberField } from "./number-field";
import { SelectField } from "./select-field";
import { setColour, setTable } from "../film/document";
import { quantityOf } from "../film/quantity";
import {
  cosineCount,
  ILLUMINANTS,
  including,
  OBSERVERS,
  QUANTITIES,
  type Scales,
  scalesOf,
  setQuantity,
  setScales,
  SPACES,
} from "../film/table";
import { edit, spec } from "../state/editor";

const FIRST_SCALES: Scales = { start: 0.5, stop: 1.5, count: 65 };
const COUNT = "how many, a whole number from 2";

export function TablePart() {
  const quantity = quantityOf(spec.value);
  return (
    <details class="table-part">
      <summary>Table of the downloads</summary>
      <div class="surface-fields">
        <SelectField label="Quantity" value={quantity} words={QUANTITIES} onValue={(chosen) => edit(setQuantity(chosen))} />
        {quantity !== "bsdf" && <Cosines />}
        {quantity !== "bsdf" && <ThicknessScales />}
        <Colour />
      </div>
    </details>
  );
}

function Cosines() {
  const count = cosineCount(spec.value);
  if (count === undefined) return <p class="quiet">The cosines of the angle are listed in the spec, and kept.</p>;
  return (
    <span>
      <NumberField
        label="Samples over the cosine of the angle"
        value={count}
        expected={COUNT}
        step={1}
        path="table.cos_theta"
        onValue={(value) => edit(setTable({ cos_theta: value }), "table.cos_theta")}
      />
    </span>
  );
}

function ThicknessScales() {
  const scales = scalesOf(spec.value);
  if (scales === "list") return <p class="quiet">The factors on the thickness are listed in the spec, and kept.</p>;
  return (
    <>
      <label>
        <input
          type="checkbox"
          checked={scales !== "one"}
          onChange={({ currentTarget }) => edit(setScales(currentTarget.checked ? FIRST_SCALES : "one"))}
        />{" "}
        Over a range of thicknesses
      </label>
      {scales !== "one" && <ScaleFields scales={scales} />}
    </>
  );
}

function ScaleFields({ scales }: { readonly scales: Scales }) {
  const field = (name: keyof Scales, label: string, expected: string, step: number) => (
    <NumberField
      label={label}
      value={scales[name]}
      expected={expected}
      step={step}
      path={`table.thickness_scale.${name}`}
      onValue={(value) => edit(setScales({ ...scales, [name]: value }), `table.thickness_scale.${name}`)}
    />
  );
  return (
    <div class="pair">
      {field("start", "From, times the thickness", "a factor, more than 0", 0.05)}
      {field("stop", "To, times", "a factor, more than the first", 0.05)}
      {field("count", "Samples", COUNT, 1)}
    </div>
  );
}

function Colour() {
  const { illuminant = "D65", observer = "CIE 1931 2 Degree Standard Observer", space = "Rec.709" } = spec.value.colour ?? {};
  return (
    <>
      <SelectField
        label="Light that the colours are seen in"
        value={illuminant}
        words={including(ILLUMINANTS, illuminant)}
        onValue={(chosen) => edit(setColour({ illuminant: chosen }))}
      />
      <SelectField
        label="Observer"
        value={observer}
        words={including(OBSERVERS, observer)}
        onValue={(chosen) => edit(setColour({ observer: chosen }))}
      />
      <SelectField label="Space of the colours" value={space} words={SPACES} onValue={(chosen) => edit(setColour({ space: chosen }))} />
    </>
  );
}
