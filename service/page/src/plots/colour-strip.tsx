/** The film's colour over the angle and the thickness, from the lookup texture itself. */

import type { LookupTexture } from "@nacreous/three";
import { useMemo, useState } from "preact/hooks";

import { LARGEST_THETA_DEGREES } from "./angle-slider";
import { Plot, PlotState } from "./plot";
import { StripPicture, type StripPlace } from "./strip-picture";
import { hex, luminance } from "../film/colour";
import { colourAt, outOfGamutShare } from "../film/lookup-colour";
import { degrees, nanometres, percent } from "../film/numbers";
import { onlyThicknessNm, scaleThicknesses } from "../film/thickness";
import { SCALES } from "../film/views";
import { edit } from "../state/editor";
import { lookup, type Lookup } from "../state/lookup";
import { thetaDegrees } from "../state/view";
import "./colour-strip.css";

const SCALE_STEP = 0.01;

export function ColourStrip() {
  const { answer } = lookup.value;
  return (
    <Plot title="Colour over angle and thickness" class="colour-strip">
      {answer ? <Strip lookup={answer} /> : <div class="strip-frame" />}
      <PlotState asking={lookup.value} waiting="The colours are being computed." />
    </Plot>
  );
}

function Strip({ lookup: { reflectance, spec } }: { readonly lookup: Lookup }) {
  const [scale, setScale] = useState(1);
  const [hovered, setHovered] = useState<StripPlace>();
  const chosen = { thetaDegrees: thetaDegrees.value, scale };
  const only = onlyThicknessNm(spec);
  const choose = (place: StripPlace) => {
    thetaDegrees.value = limited(Math.round(place.thetaDegrees), 0, LARGEST_THETA_DEGREES);
    setScale(limited(Math.round(place.scale / SCALE_STEP) * SCALE_STEP, SCALES.start, SCALES.stop));
  };
  const outside = useMemo(() => outOfGamutShare(reflectance), [reflectance]);
  const described = description(reflectance, chosen, only);
  return (
    <>
      <StripPicture
        texture={reflectance}
        chosen={chosen}
        described={described}
        thicknessLabel={(at) => (only === undefined ? `${at} ×` : nanometres(at * only))}
        onChoose={choose}
        onHover={setHovered}
      />
      <Reading texture={reflectance} place={hovered ?? chosen} only={only} />
      <p class="strip-foot">
        <button type="button" disabled={scale === 1} onClick={() => useThickness(scale, setScale)}>
          Use this thickness
        </button>
        <span>{gamutWords(outside)}</span>
      </p>
    </>
  );
}

function useThickness(scale: number, setScale: (scale: number) => void): void {
  edit(scaleThicknesses(scale));
  setScale(1);
}

interface ReadingProps {
  readonly texture: LookupTexture;
  readonly place: StripPlace;
  readonly only: number | undefined;
}

function Reading({ texture, place, only }: ReadingProps) {
  const colour = colourOf(texture, place);
  return (
    <p class="reading">
      <span class="swatch" style={{ background: hex(colour) }} /> <b>{hex(colour)}</b>, R <b>{percent(luminance(colour))}</b>{" "}
      at {degrees(place.thetaDegrees)}, {thicknessWords(place.scale, only)}
    </p>
  );
}

function colourOf(texture: LookupTexture, { thetaDegrees: theta, scale }: StripPlace) {
  return colourAt(texture, Math.cos((theta * Math.PI) / 180), scale);
}

function description(texture: LookupTexture, place: StripPlace, only: number | undefined): string {
  const colour = colourOf(texture, place);
  const where = `${Math.round(place.thetaDegrees)} degrees, ${thicknessWords(place.scale, only)}`;
  return `${where}: colour ${hex(colour)}, R ${percent(luminance(colour))}`;
}

function thicknessWords(scale: number, only: number | undefined): string {
  const factor = `${scale.toFixed(2)} times the thickness`;
  return only === undefined ? factor : nanometres(scale * only);
}

function gamutWords(share: number): string {
  if (share === 0) return "A screen can show all of these colours.";
  const percentage = share < 0.001 ? "Less than 0.1 %" : percent(share);
  return `${percentage} of these colours are beyond what a screen can show; they are clipped here.`;
}

function limited(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}
