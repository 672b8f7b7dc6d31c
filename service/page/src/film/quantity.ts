/** What is tabulated of a spec, changed to what a format can hold. */

import type { Change, SpecDocument } from "./document";
import { isRough } from "./lobe";

type Table = NonNullable<SpecDocument["table"]>;

const FIRST_ROUGHNESS = { distribution: "ggx", alpha_x: 0.1 } as const;
const SCALES_OF_A_FILM = { start: 0.5, stop: 1.5, count: 65 } as const;

export function quantityOf({ table }: SpecDocument): NonNullable<Table["quantity"]> {
  return table?.quantity ?? "fresnel";
}

/** The film alone, over angle and thickness: what a lookup texture holds. */
export const asFilm: Change = (spec) => {
  const { wavelength_nm, cos_theta, thickness_scale } = spec.table ?? {};
  const scale = thickness_scale === undefined || thickness_scale === 1 ? SCALES_OF_A_FILM : thickness_scale;
  return { ...spec, table: given({ quantity: "fresnel", wavelength_nm, cos_theta, thickness_scale: scale }) };
};

/** The light that a rough surface reflects from each direction to each: what a measured material holds. */
export const asLobe: Change = (spec) => {
  const surface = isRough(spec) ? spec.surface : { ...spec.surface, ...FIRST_ROUGHNESS };
  const { wavelength_nm, roughness, theta_i, theta_o, phi, phi_i } = spec.table ?? {};
  const table = given({ quantity: "bsdf", transmission: "discard", wavelength_nm, roughness, theta_i, theta_o, phi, phi_i });
  return { ...spec, surface: surface ?? null, table, accuracy: { ...spec.accuracy, delta_e: null } };
};

function given(table: { [Field in keyof Table]: Table[Field] | undefined }): Table {
  return Object.fromEntries(Object.entries(table).filter(([, value]) => value !== undefined));
}
