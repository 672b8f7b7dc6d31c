/* Made from the service's OpenAPI document by make_answers.mjs; tests/web/test_page.py compares them. */

/**
 * A material of the project's own library, or a refractiveindex.info page `shelf/book/page`.
 */
export type NamedMaterial =
  | string
  | {
      /**
       * A name that `nacreous materials` lists, or a page such as `main/Ag/Johnson`.
       */
      name: string;
      /**
       * Beyond the wavelengths of its data `"refuse"` a table, or `"hold"` the value at the nearer end.
       */
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
  /**
   * A label: what it is. Labels are not part of a table's id.
   */
  name?: string;
  /**
   * A label: what it shows.
   */
  description?: string;
  /**
   * A label: whose numbers it has.
   */
  source?: string;
  stack: Stack;
  /**
   * Without it the film is ideally smooth, or as rough as the table's roughness axis says.
   */
  surface?: Surface | null;
  table?: TableSpec;
  colour?: ColourSpec;
  accuracy?: AccuracySpec;
}
/**
 * The film: its layers, and what lies in front of them and behind.
 */
export interface Stack {
  /**
   * The half-space that the light comes from; all angles are in it.
   */
  incident: NamedMaterial | ConstantMaterial | TabulatedMaterial | CauchyMaterial | SellmeierMaterial | Mixture;
  /**
   * The half-space below the layers.
   */
  substrate: NamedMaterial | ConstantMaterial | TabulatedMaterial | CauchyMaterial | SellmeierMaterial | Mixture;
  /**
   * From the incident medium inwards; 1 to 64 layers, a group's members counted once.
   */
  layers: (Layer | Group)[];
}
/**
 * The same n + ik at every wavelength.
 */
export interface ConstantMaterial {
  /**
   * Refractive index.
   */
  n: number;
  /**
   * Extinction coefficient: positive where the material absorbs.
   */
  k?: number;
}
/**
 * n and k at ascending wavelengths, linear between them.
 */
export interface TabulatedMaterial {
  /**
   * Vacuum wavelengths of the samples, ascending.
   *
   * @minItems 2
   * @maxItems 65536
   */
  wavelength_nm: number[];
  /**
   * Refractive index at each of them, 0.001 to 1000.
   */
  n: number[];
  /**
   * Extinction coefficient at each of them, 0 to 1000; 0 where it is left out.
   */
  k?: number[] | null;
  /**
   * Beyond the wavelengths `"refuse"` a table, or `"hold"` the value at the nearer end.
   */
  extrapolate?: "refuse" | "hold";
}
/**
 * n = A + B/λ² + C/λ⁴ with λ in micrometres and a constant k, known over `range_nm`.
 */
export interface CauchyMaterial {
  /**
   * A, B in µm² and C in µm⁴; what is left out is 0.
   *
   * @minItems 1
   * @maxItems 3
   */
  cauchy: number[];
  /**
   * Extinction coefficient.
   */
  k?: number;
  /**
   * First and last vacuum wavelength at which the formula holds; any, without it.
   */
  range_nm?: [number, number] | null;
  /**
   * Beyond `range_nm` `"refuse"` a table, or `"hold"` the value at the nearer end.
   */
  extrapolate?: "refuse" | "hold";
}
/**
 * A Sellmeier formula and a constant k, known over `range_nm`.
 */
export interface SellmeierMaterial {
  sellmeier: SellmeierCoefficients;
  /**
   * Extinction coefficient.
   */
  k?: number;
  /**
   * First and last vacuum wavelength at which the formula holds; any, without it.
   */
  range_nm?: [number, number] | null;
  /**
   * Beyond `range_nm` `"refuse"` a table, or `"hold"` the value at the nearer end.
   */
  extrapolate?: "refuse" | "hold";
}
/**
 * The formula's coefficients.
 */
export interface SellmeierCoefficients {
  /**
   * Strengths of the resonances.
   *
   * @minItems 1
   * @maxItems 16
   */
  b: number[];
  /**
   * Squares of their wavelengths, as many as `b` has.
   */
  c_um2: number[];
  /**
   * What resonances far away add.
   */
  constant?: number;
}
/**
 * Inclusions of volume share `fraction` in a host, far finer than the wavelength.
 */
export interface Mixture {
  /**
   * One of the two materials; it may be a mixture itself, four deep at most.
   */
  host: NamedMaterial | ConstantMaterial | TabulatedMaterial | CauchyMaterial | SellmeierMaterial | Mixture;
  /**
   * One of the two materials; it may be a mixture itself, four deep at most.
   */
  inclusion: NamedMaterial | ConstantMaterial | TabulatedMaterial | CauchyMaterial | SellmeierMaterial | Mixture;
  /**
   * Share of the inclusions in the volume.
   */
  fraction: number;
  /**
   * How both make one index: `"bruggeman"`, `"maxwell-garnett"` or `"lamellar"`.
   */
  rule: "bruggeman" | "maxwell-garnett" | "lamellar";
}
/**
 * One film.
 */
export interface Layer {
  /**
   * What it consists of.
   */
  material: NamedMaterial | ConstantMaterial | TabulatedMaterial | CauchyMaterial | SellmeierMaterial | Mixture;
  /**
   * Its thickness: 1e-6 to 1e8, or 0 for a layer that is absent.
   */
  thickness_nm: number;
  /**
   * Standard deviation of the thickness over the surface, at most a fifth of it; R and T are averaged.
   */
  thickness_sigma_nm?: number;
  /**
   * False for a thick layer across which intensities are added instead of amplitudes.
   */
  coherent?: boolean;
}
/**
 * A periodic group: its layers, in order, `repeat` times.
 */
export interface Group {
  /**
   * How often the layers stand there; a thousand times cost about twice as much as once.
   */
  repeat: number;
  /**
   * One period, from the incident medium inwards; all of them coherent, and none a group itself.
   *
   * @minItems 1
   * @maxItems 64
   */
  layers: Layer[];
}
/**
 * A rough surface, its roughness given by alpha or by exponent, or left to a table's roughness axis.
 */
export interface Surface {
  /**
   * Distribution D of the facets, `"ashikhmin-shirley"`, `"blinn"`, `"phong"`, `"ggx"` or `"beckmann"`; `"blinn"` and `"phong"` are isotropic.
   */
  distribution?: "ashikhmin-shirley" | "blinn" | "phong" | "ggx" | "beckmann";
  /**
   * Roughness along x and y, 0.001 to 1; y is x where it is left out.
   */
  alpha_x?: number | null;
  /**
   * Roughness along x and y, 0.001 to 1; y is x where it is left out.
   */
  alpha_y?: number | null;
  /**
   * Roughness along x and y as exponents, 0 to 1,999,998: exponent = 2 / alpha² - 2.
   */
  exponent_x?: number | null;
  /**
   * Roughness along x and y as exponents, 0 to 1,999,998: exponent = 2 / alpha² - 2.
   */
  exponent_y?: number | null;
  /**
   * `"v-cavity"`, the paper's equation 13 (Torrance and Sparrow 1967), `"smith"`, height-correlated (Heitz 2014, equation 99), or `"smith-separable"` (Walter et al. 2007, equation 23). `"phong"` has `"v-cavity"` alone.
   */
  masking?: "v-cavity" | "smith" | "smith-separable";
  /**
   * Factor on the light of the facets: the paper's c_b in its equation 12, 0 to 1000.
   */
  specular_weight?: number;
  /**
   * Factor on the diffuse term: the paper's c_a in its equation 12, 0 to 1000.
   */
  diffuse_weight?: number;
  /**
   * Albedo of the diffuse term, 0 to 1.
   */
  diffuse_reflectance?: number;
  /**
   * `"none"`, as in the paper, or `"kulla-conty"`: the light that several facets reflect is added (C. Kulla and A. Conty 2017), coloured by the film (S. Hill 2018); what they would transmit later is not. `"phong"` has `"none"` alone.
   */
  multiple_scattering?: "none" | "kulla-conty";
}
/**
 * What is tabulated, over which axes.
 */
export interface TableSpec {
  /**
   * `"fresnel"`: R and T of the film for s and p. `"albedo"`: the share of the light that the rough surface reflects and transmits, by direction. `"bsdf"`: how it scatters from each direction to each.
   */
  quantity?: "fresnel" | "albedo" | "bsdf";
  /**
   * Vacuum wavelengths, 100 to 100,000 nm.
   */
  wavelength_nm?: number[] | Range;
  /**
   * Cosines of the angle of incidence, 0 to 1; a count spaces them equally over [0, 1]. A bsdf has `theta_i` in its place.
   */
  cos_theta?: number | number[] | Range;
  /**
   * Factors on every layer's thickness; 1 for a bsdf.
   */
  thickness_scale?: 1 | number[] | Range;
  /**
   * albedo and bsdf: sqrt(alpha_x alpha_y), 0.001 to 1; the surface keeps its ratio of both. Without it, the surface's own.
   */
  roughness?: number[] | Range | null;
  /**
   * bsdf: angles of incoming and outgoing light from the normal, each on its own side of the surface, 0 to 1.5707 rad; 16 and 32 where left out. A count spaces them equally over 0 to 89 degrees.
   */
  theta_i?: number | number[] | Range | null;
  /**
   * bsdf: angles of incoming and outgoing light from the normal, each on its own side of the surface, 0 to 1.5707 rad; 16 and 32 where left out. A count spaces them equally over 0 to 89 degrees.
   */
  theta_o?: number | number[] | Range | null;
  /**
   * bsdf: phi_o - phi_i, -pi to pi. A count spaces it equally over 0 to pi, 19 where left out; of an anisotropic surface over -pi to pi, 37 where left out.
   */
  phi?: number | number[] | Range | null;
  /**
   * bsdf of an anisotropic surface: azimuth of the incoming light, -pi to pi; 5 where left out. A count spaces it equally over 0 to pi / 2: the other quarters are its mirror images.
   */
  phi_i?: number | number[] | Range | null;
  /**
   * albedo and bsdf: `"keep"`, or `"discard"` to take what is transmitted as lost, for files and renderers that know reflected light alone.
   */
  transmission?: "keep" | "discard";
  /**
   * fresnel: whether the table holds psi and Delta as well.
   */
  ellipsometry?: boolean;
}
/**
 * Equally spaced values from `start`, by `step` or by `count`.
 */
export interface Range {
  /**
   * First value.
   */
  start: number;
  /**
   * Where the values end; more than `start`.
   */
  stop: number;
  /**
   * Distance from one value to the next; it or `count`.
   */
  step?: number | null;
  /**
   * Number of values, both ends among them; it or `step`.
   */
  count?: number | null;
}
/**
 * How spectra become colours.
 */
export interface ColourSpec {
  /**
   * The light under which the film is seen, by colour-science's name of it. `A`, `C`, `D50`, `D55`, `D65`, `D75` and `E` ship with Nacreous. Others are `D60`, the fluorescent lamps `FL1` to `FL12`, and LEDs, such as `LED-B1`.
   */
  illuminant?: string;
  /**
   * The colour-matching functions, by colour-science's name of them. `CIE 1931 2 Degree Standard Observer` and `CIE 1964 10 Degree Standard Observer` ship with Nacreous. Others are `CIE 2015 2 Degree Standard Observer` and `CIE 2015 10 Degree Standard Observer`.
   */
  observer?: string;
  /**
   * The linear RGB space of colour tables, or XYZ.
   */
  space?: "Rec.709" | "ACEScg" | "Rec.2020" | "XYZ";
}
/**
 * How exact the table is to be.
 */
export interface AccuracySpec {
  /**
   * Precision of the kernels, `"single"` or `"double"`.
   */
  precision?: "single" | "double";
  /**
   * Colour difference CIEDE2000, 0.05 to 10, that interpolation between the texels may reach; the axes of the spec are then lower bounds. A bsdf has none.
   */
  delta_e?: number | null;
}
/**
 * A spec that has been tabulated.
 */
export interface TableAdded {
  /**
   * 64 hex digits: a hash over everything that decides the values.
   */
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
  /**
   * The name of the preset.
   */
  name: string;
  /**
   * What it is.
   */
  title: string;
  /**
   * What it shows.
   */
  description: string;
  /**
   * Whose numbers it has.
   */
  source: string;
  /**
   * fresnel, albedo or bsdf.
   */
  quantity: string;
  /**
   * The preset itself, and its file in every format that can hold it.
   */
  links: {
    [k: string]: string;
  };
  /**
   * The id of its table.
   */
  id: string;
  /**
   * The spec, complete but for its labels.
   */
  spec: {
    [k: string]: unknown;
  };
}
/**
 * A preset, and where its numbers come from.
 */
export interface PresetEntry {
  /**
   * The name of the preset.
   */
  name: string;
  /**
   * What it is.
   */
  title: string;
  /**
   * What it shows.
   */
  description: string;
  /**
   * Whose numbers it has.
   */
  source: string;
  /**
   * fresnel, albedo or bsdf.
   */
  quantity: string;
  /**
   * The preset itself, and its file in every format that can hold it.
   */
  links: {
    [k: string]: string;
  };
}
/**
 * A material with samples of it.
 */
export interface MaterialAnswer {
  /**
   * The name by which a spec may call it.
   */
  name: string;
  /**
   * What a user should know about it.
   */
  description: string;
  /**
   * Whose numbers these are.
   */
  citation: string;
  /**
   * First and last vacuum wavelength of its data.
   *
   * @minItems 2
   * @maxItems 2
   */
  range_nm: [number, number];
  samples: Samples;
}
/**
 * Its n and k over the wavelengths.
 */
export interface Samples {
  /**
   * Vacuum wavelengths, ascending.
   */
  wavelength_nm: number[];
  /**
   * Refractive index at each.
   */
  n: number[];
  /**
   * Extinction coefficient at each.
   */
  k: number[];
}
/**
 * One page of the materials that were searched for.
 */
export interface MaterialList {
  /**
   * The materials of this page.
   */
  materials: MaterialEntry[];
  /**
   * How many were found in all.
   */
  total: number;
}
/**
 * A named material, and whose numbers it has.
 */
export interface MaterialEntry {
  /**
   * The name by which a spec may call it.
   */
  name: string;
  /**
   * What a user should know about it.
   */
  description: string;
  /**
   * Whose numbers these are.
   */
  citation: string;
  /**
   * First and last vacuum wavelength of its data.
   *
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
  /**
   * The phrase of the status.
   */
  title: string;
  /**
   * The status of the answer.
   */
  status: number;
  /**
   * One message for a person.
   */
  detail: string;
  /**
   * Dotted path of the field that is wrong.
   */
  field?: string | null;
  /**
   * What may stand there.
   */
  expected?: string | null;
  /**
   * What came, shortened.
   */
  got?: string | null;
  /**
   * What to do instead, where that is known.
   */
  remedy?: string | null;
}
/**
 * A spec that takes too long to wait for: a job computes it.
 */
export interface JobAccepted {
  job: JobAnswer;
  /**
   * Where the job is, and where the table will be.
   */
  links: {
    [k: string]: string;
  };
}
/**
 * The job.
 */
export interface JobAnswer {
  /**
   * 64 hex digits: a hash over the sweep.
   */
  id: string;
  /**
   * queued, running, done, failed or cancelled.
   */
  state: string;
  /**
   * Tables that are finished.
   */
  done: number;
  /**
   * Tables that could not be made.
   */
  failed: number;
  /**
   * Tables of the sweep.
   */
  total: number;
  /**
   * How much is done, 0 to 1, of the table in hand as well.
   */
  fraction: number;
  /**
   * Why, of the first few that could not be made.
   */
  failures: FailureAnswer[];
  /**
   * When it was sent, in UTC as ISO 8601 has it.
   */
  created: string;
  /**
   * The formats of every table.
   */
  formats: string[];
  /**
   * Why the job as a whole has ended, where it has failed.
   */
  error?: string | null;
  /**
   * The job itself, and its events.
   */
  links: {
    [k: string]: string;
  };
  /**
   * The finished tables, in the order of the sweep.
   */
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
  /**
   * Why it could not be made.
   */
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
  /**
   * The id of the table.
   */
  id: string;
  /**
   * The table itself, and its files of the job's formats.
   */
  links: {
    [k: string]: string;
  };
}
