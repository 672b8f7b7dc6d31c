/** The film's spectrum at the angle that is looked at. */

import { follower } from "./asking";
import { atRest } from "./at-rest";
import { spec } from "./editor";
import { thetaDegrees } from "./view";
import { column, parseCsv } from "../film/csv-table";
import type { SpecDocument } from "../film/document";
import { spectrumSpec } from "../film/views";
import { addTable, text } from "../service/service";

const REST_MS = 150;

/** R and T, each over the wavelengths. */
export interface Spectrum {
  readonly thetaDegrees: number;
  readonly wavelengthNm: readonly number[];
  readonly R_s: readonly number[];
  readonly R_p: readonly number[];
  readonly T_s: readonly number[];
  readonly T_p: readonly number[];
  /** The table as the service wrote it. */
  readonly csv: string;
}

interface Asked {
  readonly spec: SpecDocument;
  readonly thetaDegrees: number;
}

const followed = follower(fetchSpectrum);
export const spectrum = followed.state;

/** Follow the spec and the angle from now on. */
export function followSpectrum(): () => void {
  return atRest(REST_MS, () => ({ spec: spec.value, thetaDegrees: thetaDegrees.value }), followed.ask);
}

async function fetchSpectrum({ spec: document, thetaDegrees: theta }: Asked): Promise<Spectrum> {
  const { links } = await addTable(spectrumSpec(document, theta));
  if (!links["csv"]) throw new Error("expected a link to the spectrum as csv, found none");
  const csv = await text(links["csv"]);
  return { ...spectrumOf(csv, theta), csv };
}

function spectrumOf(csv: string, theta: number): Omit<Spectrum, "csv"> {
  const columns = parseCsv(csv);
  const cosTheta = column(columns, "cos_theta");
  const wanted = nearest(cosTheta, Math.cos((theta * Math.PI) / 180));
  const at = (name: string) => column(columns, name).filter((_, row) => cosTheta[row] === wanted);
  const intensities = { R_s: at("R_s"), R_p: at("R_p"), T_s: at("T_s"), T_p: at("T_p") };
  return { thetaDegrees: theta, wavelengthNm: at("wavelength_nm"), ...intensities };
}

function nearest(values: readonly number[], wanted: number): number {
  return values.reduce((best, value) => (Math.abs(value - wanted) < Math.abs(best - wanted) ? value : best), Infinity);
}
