/** What the film lies on: a smooth surface, or facets, and how rough these are. */

import { useId } from "preact/hooks";

import { NumberField } from "./number-field";
import { SelectField } from "./select-field";
import { TablePart } from "./table-part";
import { setSurface } from "../film/document";
import {
  alphas,
  canBeBrushed,
  choice,
  DISTRIBUTIONS,
  hasOwnY,
  MASKINGS,
  roughen,
  SCATTERINGS,
  setAlphas,
  setDistribution,
  smoothen,
} from "../film/surface";
import { edit, spec } from "../state/editor";
import "./surface-panel.css";

const ROUGHNESS = "a roughness, 0.001 to 1";
const STEP = 0.01;

export function SurfacePanel() {
  const id = useId();
  const isRough = spec.value.surface != null;
  return (
    <section class="surface-panel" aria-labelledby={id}>
      <h2 id={id}>Surface</h2>
      <fieldset class="two-ways">
        <legend class="unseen">Smooth or rough</legend>
        <label>
          <input type="radio" name={id} checked={!isRough} onChange={() => edit(smoothen)} />
          <span>Smooth</span>
        </label>
        <label>
          <input type="radio" name={id} checked={isRough} onChange={() => edit(roughen)} />
          <span>Rough</span>
        </label>
      </fieldset>
      {isRough && <Facets />}
      <TablePart />
    </section>
  );
}

function Facets() {
  const isPhong = choice(spec.value, "distribution") === "phong";
  return (
    <div class="surface-fields">
      <SelectField
        label="How the facets lie"
        value={choice(spec.value, "distribution")}
        words={DISTRIBUTIONS}
        onValue={(distribution) => edit(setDistribution(distribution))}
      />
      <Roughness />
      <SelectField
        label="How facets hide each other"
        value={choice(spec.value, "masking")}
        words={MASKINGS}
        isDisabled={isPhong}
        onValue={(masking) => edit(setSurface({ masking }))}
      />
      <SelectField
        label="What light counts"
        value={choice(spec.value, "multiple_scattering")}
        words={SCATTERINGS}
        isDisabled={isPhong}
        onValue={(multiple_scattering) => edit(setSurface({ multiple_scattering }))}
      />
    </div>
  );
}

function Roughness() {
  const given = alphas(spec.value);
  if (!given) return <p class="quiet">The roughness is an axis of the table, and no single number.</p>;
  const [x, y] = given;
  const ownY = hasOwnY(spec.value);
  return (
    <>
      <div class="pair">
        <NumberField
          label={ownY ? "Roughness along x" : "Roughness"}
          value={x}
          expected={ROUGHNESS}
          step={STEP}
          path="surface.alpha_x"
          onValue={(value) => edit(setAlphas(value, ownY ? y : undefined), "surface.alpha_x")}
        />
        {ownY && (
          <NumberField
            label="Roughness along y"
            value={y}
            expected={ROUGHNESS}
            step={STEP}
            path="surface.alpha_y"
            onValue={(value) => edit(setAlphas(x, value), "surface.alpha_y")}
          />
        )}
      </div>
      {canBeBrushed(spec.value) && (
        <label>
          <input
            type="checkbox"
            checked={ownY}
            onChange={({ currentTarget }) => edit(setAlphas(x, currentTarget.checked ? y : undefined))}
          />{" "}
          Brushed: rougher across than along
        </label>
      )}
    </>
  );
}
