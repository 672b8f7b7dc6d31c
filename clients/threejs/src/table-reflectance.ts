import { DataTexture, FloatType, type IUniform, NearestFilter, RedFormat } from "three";

import type { Axis } from "./axis";
import type { LookupTexture } from "./lookup-texture";
import type { Reflectance } from "./reflectance";
import tableGLSL from "./shaders/table.glsl?raw";

/**
 * A film from its table of R and, to be seen through, its table of T.
 *
 * @throws Error if the tables are exchanged or belong to different films.
 */
export function tableReflectance(table: LookupTexture, transmittance?: LookupTexture): Reflectance {
  expectQuantity(table, "R");
  if (transmittance) expectCompanion(table, transmittance);
  const values = axisValues(table.axes.x, table.axes.y);
  const uniforms: Record<string, IUniform> = {
    nacreousTable: { value: table.texture },
    nacreousAxisX: { value: axisUniform(table.axes.x) },
    nacreousAxisY: { value: axisUniform(table.axes.y) },
    nacreousAxisValues: { value: values },
  };
  if (transmittance) uniforms.nacreousTransmittanceTable = { value: transmittance.texture };
  const transmits = transmittance !== undefined;
  return {
    key: transmits ? "table, transmitting" : "table",
    glsl: (transmits ? "#define NACREOUS_TRANSMITTANCE\n" : "") + tableGLSL,
    uniforms,
    transmits,
    dispose: () => { values.dispose(); },
  };
}

function expectQuantity(table: LookupTexture, quantity: LookupTexture["quantity"]): void {
  if (table.quantity === quantity) return;
  throw new Error(`expected a table of ${quantity}, found one of ${table.quantity}`);
}

function expectCompanion(table: LookupTexture, transmittance: LookupTexture): void {
  expectQuantity(transmittance, "T");
  if (table.id === transmittance.id) return;
  throw new Error(`expected R and T of one film, found the tables ${table.id} and ${transmittance.id}`);
}

function axisUniform(axis: Axis): object {
  const [first, last] = axis.range;
  return { first, last, count: axis.count, isExplicit: axis.mapping === "explicit" };
}

/** The samples of explicit axes, x in row 0 and y in row 1. */
function axisValues(x: Axis, y: Axis): DataTexture {
  const width = Math.max(x.values?.length ?? 1, y.values?.length ?? 1);
  const data = new Float32Array(2 * width);
  data.set(x.values ?? []);
  data.set(y.values ?? [], width);
  const texture = new DataTexture(data, width, 2, RedFormat, FloatType);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}
