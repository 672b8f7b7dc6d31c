/** What to write where a file has been taken, ready to be copied: clients/ of the project says the rest. */

import type { SpecDocument } from "./document";

/** Names of the files as they are saved, by format. */
export type FileNames = Readonly<Record<string, string>>;
export type Snippet = (files: FileNames, spec: SpecDocument) => string;

/** Ends and count of an axis of a lookup texture whose steps are equal. */
interface Steps {
  readonly first: number;
  readonly last: number;
  readonly count: number;
}

export const blender: Snippet = (files) =>
  lines(
    "# Blender 4.5: the sidebar (N), panel Nacreous, Film from Texture; or by script, with the add-on installed:",
    "import bpy",
    `bpy.ops.nacreous.create_material(filepath="//${files["exr"]}")`,
  );

export const mitsuba: Snippet = (files) => {
  const measured = files["rgl"] ?? files["rgl-rgb"];
  if (measured) return lines(`<bsdf type="measured">`, `    <string name="filename" value="${measured}"/>`, `</bsdf>`);
  return lines(
    `import mitsuba as mi`,
    `import nacreous_bsdf  # clients/mitsuba/nacreous_bsdf.py and nacreous_lookup.py, beside the scene`,
    ``,
    `mi.set_variant("llvm_ad_rgb")  # in a spectral variant: ${files["spectral-exr"]}`,
    `nacreous_bsdf.register()`,
    `bsdf = {"type": "nacreous", "filename": "${files["exr"]}", "thickness_scale": 1.0, "alpha": 0.1}`,
  );
};

export const pbrt: Snippet = (files) => `Material "measured" "string filename" "${files["rgl"]}"`;

export const threejs: Snippet = (files) => {
  const transmission = files["exr-transmission"];
  const through = transmission ? [`  transmittance: await loadLookupTexture("${transmission}"),`] : [];
  return lines(
    `import { loadLookupTexture, NacreousMaterial } from "@nacreous/three";`,
    ``,
    `const material = new NacreousMaterial({`,
    `  film: await loadLookupTexture("${files["exr"]}"),`,
    ...through,
    `  roughness: 0.2,`,
    `  thicknessScale: 1,`,
    `});`,
  );
};

export const osl: Snippet = (files, spec) => {
  const { across, down } = stepsOf(spec);
  return lines(
    `// Parameters of clients/osl/nacreous_film.osl`,
    `string filename = "${files["exr"]}",`,
    ...(files["exr-transmission"] ? [`string transmission_filename = "${files["exr-transmission"]}",`] : []),
    `int columns = ${across?.count ?? AS_IN_FILE}, int rows = ${down?.count ?? AS_IN_FILE},`,
    `float cos_theta_first = ${across?.first ?? AS_IN_FILE}, float cos_theta_last = ${across?.last ?? AS_IN_FILE},`,
    `float thickness_first = ${down?.first ?? AS_IN_FILE}, float thickness_last = ${down?.last ?? AS_IN_FILE},`,
  );
};

export const unreal: Snippet = (_, spec) => {
  const { across, down } = stepsOf(spec);
  return lines(
    `// Custom node, Include File Paths /Project/NacreousFilm.ush`,
    `// CosThetaAxis = ${vector(across)}, ThicknessScaleAxis = ${vector(down)}`,
    `return NacreousReflectance(Table, TableSampler, CosTheta, ThicknessScale, CosThetaAxis, ThicknessScaleAxis);`,
  );
};

export const unity: Snippet = (_, spec) => {
  const { across, down } = stepsOf(spec);
  return lines(
    `// Custom Function node: Source NacreousFilm.hlsl, Name NacreousReflectance`,
    `// CosThetaAxis = ${vector(across)}, ThicknessScaleAxis = ${vector(down)}`,
  );
};

export const python: Snippet = (files, spec) => {
  const name = spec.table?.quantity === "bsdf" ? "f_r" : spec.table?.quantity === "albedo" ? "E_r" : "R_s";
  return lines(
    `import xarray`,
    ``,
    `table = xarray.open_dataset("${files["netcdf"]}")`,
    `print(table["${name}"].sel(wavelength_nm=550, method="nearest"))`,
  );
};

export const spreadsheet: Snippet = (files) =>
  lines(`import pandas`, ``, `table = pandas.read_csv("${files["csv"]}", comment="#")`);

const AS_IN_FILE = "/* see nacreous:axis in the file */";

function stepsOf({ table, accuracy }: SpecDocument): { across?: Steps; down?: Steps } {
  if (accuracy?.delta_e) return {}; // the service chooses the axes
  const across = steps(table?.cos_theta ?? 64);
  const down = table?.thickness_scale === undefined || table.thickness_scale === 1 ? ONE_SCALE : steps(table.thickness_scale);
  return { ...(across ? { across } : {}), ...(down ? { down } : {}) };
}

/** One value of an axis is two equal texels. */
const ONE_SCALE: Steps = { first: 1, last: 1, count: 2 };

function steps(axis: number | number[] | { start: number; stop: number; step?: number | null; count?: number | null }): Steps | undefined {
  if (typeof axis === "number") return { first: 0, last: 1, count: axis };
  if (Array.isArray(axis)) return undefined;
  const { start, stop, step } = axis;
  const count = axis.count ?? Math.floor((stop - start) / (step ?? 1) + 1e-6) + 1;
  return { first: start, last: step ? start + (count - 1) * step : stop, count };
}

function vector(axis: Steps | undefined): string {
  return axis ? `(${axis.first}, ${axis.last}, ${axis.count})` : "(first, last, count) of nacreous:axis in the file";
}

function lines(...all: string[]): string {
  return all.join("\n");
}
