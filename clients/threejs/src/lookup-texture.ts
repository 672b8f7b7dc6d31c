/** The lookup textures of Nacreous: clients/README.md of the project is their contract. */

import { ClampToEdgeWrapping, DataTexture, FloatType, HalfFloatType, LinearFilter, NoColorSpace } from "three";
import { EXRLoader } from "three/addons/loaders/EXRLoader.js";

import { type Axis, parseAxis } from "./axis";
import { readTextAttributes } from "./exr-header";

/** What a texture of a smooth film holds: the colour of its reflectance or of its transmittance. */
export type Quantity = "R" | "T";

/** A lookup texture, ready for a shader. */
export interface LookupTexture {
  /** Linear colour: data, clamped, filtered, without mip levels. Row 0 of the file, the smallest scale, is at v = 1. */
  readonly texture: DataTexture;
  /** `x` is cos_theta and `y` thickness_scale. */
  readonly axes: { readonly x: Axis; readonly y: Axis };
  readonly quantity: Quantity;
  /** SHA-256 over all that decides the values: a film's R and its T have the same. */
  readonly id: string;
  /** The version of Nacreous that wrote the file. */
  readonly version: string;
  /** The film and how it was tabulated, as it was written. */
  readonly spec: unknown;
  /** The errors that were measured between the texels; figures that do not apply are null. */
  readonly certificate: Readonly<Record<string, number | null>>;
}

/** How a lookup texture is held. */
export interface LookupTextureOptions {
  /** `FloatType`, or `HalfFloatType` for GPUs that do not filter float32 (no OES_texture_float_linear). */
  readonly type?: typeof FloatType | typeof HalfFloatType;
}

type Attributes = ReadonlyMap<string, string>;

/**
 * Load a lookup texture.
 *
 * @throws Error, with the address, if there is no such file or it is not a lookup texture of a smooth film in Rec.709.
 */
export async function loadLookupTexture(url: string, options: LookupTextureOptions = {}): Promise<LookupTexture> {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: the server answered ${response.status} ${response.statusText}`);
  const file = await response.arrayBuffer();
  try {
    return parseLookupTexture(file, options);
  } catch (error) {
    throw new Error(`${url}: ${error instanceof Error ? error.message : String(error)}`, { cause: error });
  }
}

/**
 * Read a lookup texture from the bytes of its file.
 *
 * @throws Error if it is not a lookup texture of a smooth film in Rec.709.
 */
export function parseLookupTexture(file: ArrayBuffer, options: LookupTextureOptions = {}): LookupTexture {
  const type = options.type ?? FloatType;
  const description = describe(readTextAttributes(file));
  const { width, height, data } = decode(file, type);
  const texture = new DataTexture(data, width, height, undefined, type);
  texture.colorSpace = NoColorSpace;
  texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return { texture, ...description };
}

interface Image {
  readonly width: number;
  readonly height: number;
  readonly data: Float32Array<ArrayBuffer> | Uint16Array<ArrayBuffer>;
}

/** The loader writes the rows of the file from the bottom up, which is how WebGL counts v. */
function decode(file: ArrayBuffer, type: typeof FloatType | typeof HalfFloatType): Image {
  try {
    return new EXRLoader().setDataType(type).parse(file) as unknown as Image;
  } catch (error) {
    throw new Error("the OpenEXR file is damaged, or of a kind that three.js cannot read", { cause: error });
  }
}

function describe(attributes: Attributes): Omit<LookupTexture, "texture"> {
  return {
    quantity: fresnelQuantity(attribute(attributes, "nacreous:quantity")),
    axes: {
      x: parseAxis("nacreous:axis.x", attribute(attributes, "nacreous:axis.x")),
      y: parseAxis("nacreous:axis.y", attribute(attributes, "nacreous:axis.y")),
    },
    ...identity(attributes),
    spec: JSON.parse(attribute(attributes, "nacreous:spec")),
    certificate: JSON.parse(attribute(attributes, "nacreous:certificate")),
  };
}

function identity(attributes: Attributes): Pick<LookupTexture, "id" | "version"> {
  const space = attribute(attributes, "nacreous:colour.space");
  if (space !== "Rec.709") {
    throw new Error(`expected colours in Rec.709, as three.js has, found ${space}: tabulate with space = "Rec.709"`);
  }
  return { id: attribute(attributes, "nacreous:id"), version: attribute(attributes, "nacreous:version") };
}

function attribute(attributes: Attributes, name: string): string {
  const value = attributes.get(name);
  if (value !== undefined) return value;
  throw new Error(`expected a lookup texture of Nacreous, found an OpenEXR file without the attribute ${name}`);
}

const ROUGH: Readonly<Record<string, string>> = {
  E_r: "an albedo",
  E_t: "an albedo",
  f_r: "a BSDF",
  f_t: "a BSDF",
};

function fresnelQuantity(quantity: string): Quantity {
  if (quantity === "R" || quantity === "T") return quantity;
  const found = `${quantity}, ${ROUGH[quantity] ?? "which is unknown"}`;
  throw new Error(`expected R or T of a smooth film, found ${found}: tabulate with quantity = "fresnel"`);
}
