/** The angle of incidence of the plots. */

import { useId } from "preact/hooks";

import { degrees } from "../film/numbers";
import { thetaDegrees } from "../state/view";
import "./angle-slider.css";

export const LARGEST_THETA_DEGREES = 89;

export function AngleSlider() {
  const id = useId();
  return (
    <div class="angle-slider">
      <label for={id}>Angle of incidence</label>
      <input
        id={id}
        type="range"
        min="0"
        max={LARGEST_THETA_DEGREES}
        step="1"
        value={thetaDegrees.value}
        aria-valuetext={`${Math.round(thetaDegrees.value)} degrees`}
        onInput={({ currentTarget }) => {
          thetaDegrees.value = Number(currentTarget.value);
        }}
      />
      <output for={id}>{degrees(thetaDegrees.value)}</output>
    </div>
  );
}
