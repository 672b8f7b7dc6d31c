/** The materials of a spec, in words, and what a choice makes of them. */

import type { Material } from "./document";
import { decimals } from "./numbers";

/** How a material is given. Those beyond the first two are shown, and kept as they are. */
export type MaterialKind = "named" | "constant" | "tabulated" | "cauchy" | "sellmeier" | "mixture";

export function kindOf(material: Material): MaterialKind {
  if (typeof material === "string" || "name" in material) return "named";
  if ("cauchy" in material) return "cauchy";
  if ("sellmeier" in material) return "sellmeier";
  if ("host" in material) return "mixture";
  return "wavelength_nm" in material ? "tabulated" : "constant";
}

/** Its name in the library; nothing where it has none. */
export function nameOf(material: Material): string {
  if (typeof material === "string") return material;
  return "name" in material ? material.name : "";
}

/** A named material, which keeps its last value beyond its data. */
export function held(material: Material): Material {
  return { name: nameOf(material), extrapolate: "hold" };
}

export function isHeld(material: Material): boolean {
  return typeof material !== "string" && "extrapolate" in material && material.extrapolate === "hold";
}

/** What a material is, in a line. */
export function described(material: Material): string {
  if (typeof material === "string") return material;
  if ("name" in material) return isHeld(material) ? `${material.name}, held beyond its data` : material.name;
  if ("cauchy" in material) return `Cauchy formula ${material.cauchy.map(decimals).join(", ")}`;
  if ("sellmeier" in material) return `Sellmeier formula of ${counted(material.sellmeier.b.length, "term")}`;
  if ("host" in material) return mixture(material.fraction, described(material.inclusion), described(material.host), material.rule);
  if ("wavelength_nm" in material) return `Table of n and k at ${counted(material.wavelength_nm.length, "wavelength")}`;
  return material.k ? `${material.n} + ${material.k}i` : `n ${material.n}`;
}

function mixture(fraction: number, inclusion: string, host: string, rule: string): string {
  return `${decimals(100 * fraction)} % ${inclusion} in ${host}, ${rule} mixture`;
}

function counted(count: number, what: string): string {
  return `${count} ${what}${count === 1 ? "" : "s"}`;
}
