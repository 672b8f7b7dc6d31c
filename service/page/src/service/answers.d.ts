/* Made from the service's OpenAPI document by make_answers.mjs; tests/web/test_page.py compares them. */

/**
 * A material of the project's own library, or a refractiveindex.info page ``shelf/book/page``.
 */
export type NamedMaterial =
  | string
  | {
      name: string;
      extrapolate?: "refuse" | "hold";
    };

export interface Answers {
  Spec?: Spec;
  TableAdded?: TableAdded;
  PresetAnswer?: PresetAnswer;
  PresetEntry?: PresetEntry;
  MaterialAnswer?: MaterialAnswer;
  MaterialList?: MaterialList;
  ProblemAnswer?: ProblemAnswer;
  JobAccepted?: JobAccepted;
}
/**
 * A thin-film structure and the table wanted of it.
 */
export interface Spec {
  name?: string;
  description?: string;
  source?: string;
  stack: Stack;
  surface?: Surface | null;
  table?: TableSpec;
  colour?: ColourSpec;
  accuracy?: AccuracySpec;
}
/**
 * Layers between an incident medium, which must not absorb, and a substrate.
 */
export interface Stack {
  incident: NamedMaterial | ConstantMaterial | TabulatedMaterial | CauchyMaterial | SellmeierMaterial | Mixture;
  substrate: NamedMaterial | ConstantMaterial | TabulatedMaterial | CauchyMaterial | SellmeierMaterial | Mixture;
  layers: (Layer | Group)[];
}
/**
 * The same n + ik at every wavelength.
 */
export interface ConstantMaterial {
  n: number;
  k?: number;
}
/**
 * n and k at ascending wavelengths, linear between them; k is 0 where it is left out.
 */
export interface TabulatedMaterial {
  /**
   * @minItems 2
   * @maxItems 65536
   */
  wavelength_nm: number[];
  n: number[];
  k?: number[] | null;
  extrapolate?: "refuse" | "hold";
}
/**
 * n = A + B/λ² + C/λ⁴ with λ in micrometres and a constant k, known over `range_nm`.
 */
export interface CauchyMaterial {
  /**
   * @minItems 1
   * @maxItems 3
   */
  cauchy: number[];
  k?: number;
  range_nm?: [number, number] | null;
  extrapolate?: "refuse" | "hold";
}
/**
 * A Sellmeier formula and a constant k, known over `range_nm`.
 */
export interface SellmeierMaterial {
  sellmeier: SellmeierCoefficients;
  k?: number;
  range_nm?: [number, number] | null;
  extrapolate?: "refuse" | "hold";
}
/**
 * n² = 1 + constant + Σ b λ² / (λ² - c_um2) with λ in micrometres.
 */
export interface SellmeierCoefficients {
  /**
   * @minItems 1
   * @maxItems 16
   */
  b: number[];
  c_um2: number[];
  constant?: number;
}
/**
 * Inclusions of volume share `fraction` in a host, far finer than the wavelength.
 */
export interface Mixture {
  host: NamedMaterial | ConstantMaterial | TabulatedMaterial | CauchyMaterial | SellmeierMaterial | Mixture;
  inclusion: NamedMaterial | ConstantMaterial | TabulatedMaterial | CauchyMaterial | SellmeierMaterial | Mixture;
  fraction: number;
  rule: "bruggeman" | "maxwell-garnett" | "lamellar";
}
/**
 * One film.
 */
export interface Layer {
  material: NamedMaterial | ConstantMaterial | TabulatedMaterial | CauchyMaterial | SellmeierMaterial | Mixture;
  thickness_nm: number;
  thickness_sigma_nm?: number;
  coherent?: boolean;
}
/**
 * A periodic group: its layers, in order, `repeat` times.
 */
export interface Group {
  repeat: number;
  /**
   * @minItems 1
   * @maxItems 64
   */
  layers: Layer[];
}
/**
 * A rough surface, its roughness given by alpha or by exponent, or left to a table's roughness axis.
 */
export interface Surface {
  distribution?: "ashikhmin-shirley" | "blinn" | "phong" | "ggx" | "beckmann";
  alpha_x?: number | null;
  alpha_y?: number | null;
  exponent_x?: number | null;
  exponent_y?: number | null;
  masking?: "v-cavity" | "smith" | "smith-separable";
  specular_weight?: number;
  diffuse_weight?: number;
  diffuse_reflectance?: number;
  multiple_scattering?: "none" | "kulla-conty";
}
/**
 * What is tabulated, over which axes.
 */
export interface TableSpec {
  quantity?: "fresnel" | "albedo" | "bsdf";
  wavelength_nm?: number[] | Range;
  cos_theta?: number | number[] | Range;
  thickness_scale?: 1 | number[] | Range;
  roughness?: number[] | Range | null;
  theta_i?: number | number[] | Range | null;
  theta_o?: number | number[] | Range | null;
  phi?: number | number[] | Range | null;
  phi_i?: number | number[] | Range | null;
  transmission?: "keep" | "discard";
  ellipsometry?: boolean;
}
/**
 * Equally spaced values from `start`, by `step` or by `count`.
 */
export interface Range {
  start: number;
  stop: number;
  step?: number | null;
  count?: number | null;
}
/**
 * How a spectrum becomes a colour.
 */
export interface ColourSpec {
  illuminant?: string;
  observer?: string;
  space?: "Rec.709" | "ACEScg" | "Rec.2020" | "XYZ";
}
/**
 * How exactly a table is computed, and how closely its grid follows the film.
 */
export interface AccuracySpec {
  precision?: "single" | "double";
  delta_e?: number | null;
}
/**
 * A spec that has been tabulated.
 */
export interface TableAdded {
  id: string;
  /**
   * Whether it was unknown before.
   */
  created: boolean;
  /**
   * The errors measured of the table.
   */
  certificate: {
    [k: string]: unknown;
  };
  /**
   * The table itself, and its file in every format that can hold it.
   */
  links: {
    [k: string]: string;
  };
}
/**
 * A preset with its spec.
 */
export interface PresetAnswer {
  name: string;
  title: string;
  description: string;
  source: string;
  quantity: string;
  links: {
    [k: string]: string;
  };
  id: string;
  spec: {
    [k: string]: unknown;
  };
}
/**
 * A preset, and where its numbers come from.
 */
export interface PresetEntry {
  name: string;
  title: string;
  description: string;
  source: string;
  quantity: string;
  links: {
    [k: string]: string;
  };
}
/**
 * A material with samples of it.
 */
export interface MaterialAnswer {
  name: string;
  description: string;
  citation: string;
  /**
   * @minItems 2
   * @maxItems 2
   */
  range_nm: [number, number];
  samples: Samples;
}
/**
 * Its refractive index n + ik over the vacuum wavelength.
 */
export interface Samples {
  wavelength_nm: number[];
  n: number[];
  k: number[];
}
/**
 * One page of the materials that were searched for.
 */
export interface MaterialList {
  materials: MaterialEntry[];
  total: number;
}
/**
 * A named material, and whose numbers it has.
 */
export interface MaterialEntry {
  name: string;
  description: string;
  citation: string;
  /**
   * @minItems 2
   * @maxItems 2
   */
  range_nm: [number, number];
}
/**
 * What is wrong, as RFC 9457 has it.
 */
export interface ProblemAnswer {
  /**
   * urn:nacreous:problem: and a word.
   */
  type: string;
  title: string;
  status: number;
  detail: string;
  /**
   * Dotted path of the field that is wrong.
   */
  field?: string | null;
  expected?: string | null;
  got?: string | null;
  remedy?: string | null;
}
/**
 * A spec that takes too long to wait for: a job computes it.
 */
export interface JobAccepted {
  job: JobAnswer;
  links: {
    [k: string]: string;
  };
}
/**
 * A job and its finished tables, one page of them.
 */
export interface JobAnswer {
  id: string;
  /**
   * queued, running, done, failed or cancelled.
   */
  state: string;
  done: number;
  failed: number;
  total: number;
  fraction: number;
  failures: FailureAnswer[];
  created: string;
  formats: string[];
  error?: string | null;
  links: {
    [k: string]: string;
  };
  tables: JobTable[];
}
/**
 * A table of a job that could not be made.
 */
export interface FailureAnswer {
  /**
   * Its index in the sweep.
   */
  spec: number;
  message: string;
}
/**
 * A finished table of a job.
 */
export interface JobTable {
  /**
   * Its index in the sweep: the last of the paths, in their order, varies fastest.
   */
  spec: number;
  id: string;
  links: {
    [k: string]: string;
  };
}
