/** What of a document from elsewhere the page can show; whether it is a film is for the service to judge, at its field. */

import type { SpecDocument } from "./document";

type Fields = Record<string, unknown>;

export function isReadable(spec: unknown): spec is SpecDocument {
  if (!isRecord(spec) || !isRecord(spec["stack"])) return false;
  const { incident, substrate, layers } = spec["stack"];
  const hasStack = isMaterial(incident) && isMaterial(substrate) && isListOf(layers, isEntry);
  const hasWords = [spec["name"], spec["description"], spec["source"]].every(absentOr(isText));
  return hasStack && hasWords && absentOr(isTable)(spec["table"]) && absentOr(isRecord)(spec["surface"]);
}

export function isRecord(value: unknown): value is Fields {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function isEntry(entry: unknown): boolean {
  if (!isRecord(entry)) return false;
  const { layers, repeat } = entry;
  return layers === undefined ? isLayer(entry) : isNumber(repeat) && isListOf(layers, isLayer);
}

function isLayer(layer: unknown): boolean {
  if (!isRecord(layer)) return false;
  const { material, thickness_nm, thickness_sigma_nm } = layer;
  return isMaterial(material) && isNumber(thickness_nm) && absentOr(isNumber)(thickness_sigma_nm);
}

/** One that the spec brings along has all that a line about it says. */
function isMaterial(material: unknown): boolean {
  if (!isRecord(material)) return isText(material);
  const { name, cauchy, sellmeier, host, inclusion, fraction, rule, wavelength_nm, n, k } = material;
  if ("name" in material) return isText(name);
  if ("cauchy" in material) return isListOf(cauchy, isNumber);
  if ("sellmeier" in material) return isRecord(sellmeier) && Array.isArray(sellmeier["b"]);
  if ("host" in material) return isMaterial(host) && isMaterial(inclusion) && isNumber(fraction) && isText(rule);
  if ("wavelength_nm" in material) return Array.isArray(wavelength_nm);
  return isNumber(n) && absentOr(isNumber)(k);
}

function isTable(table: unknown): boolean {
  return isRecord(table) && absentOr(isAxis)(table["thickness_scale"]);
}

function isAxis(axis: unknown): boolean {
  if (!isRecord(axis)) return isNumber(axis) || isListOf(axis, isNumber);
  return isNumber(axis["start"]) && isNumber(axis["stop"]) && [axis["step"], axis["count"]].every(absentOr(isNumber));
}

/** A page of thousands of rows would hardly answer; the service takes 64 layers. */
const MOST_ITEMS = 1000;

function isListOf(list: unknown, is: (item: unknown) => boolean): boolean {
  return Array.isArray(list) && list.length <= MOST_ITEMS && list.every(is);
}

function absentOr(is: (value: unknown) => boolean): (value: unknown) => boolean {
  return (value) => value === undefined || value === null || is(value);
}

function isNumber(value: unknown): boolean {
  return typeof value === "number";
}

function isText(value: unknown): boolean {
  return typeof value === "string";
}
