/** The spec as it is edited: the service's own document, and changes of it. No change touches the old one. */

import type { Group, Layer, Spec, Surface } from "../service/answers";

/** What the service accepts as a spec; fields that are left out have its defaults. */
export type SpecDocument = Spec;
export type Entry = Layer | Group;
export type Material = Layer["material"];
/** The half-spaces on both sides of the film. */
export type Medium = "incident" | "substrate";
export type Table = NonNullable<SpecDocument["table"]>;
export type Change = (spec: SpecDocument) => SpecDocument;

/** Where a layer lies: its index in the stack, and within a group its index there. */
export interface Place {
  readonly entry: number;
  readonly member?: number;
}

export function isGroup(entry: Entry): entry is Group {
  return "layers" in entry;
}

/** The path of a layer's field, as the service names it in a problem. */
export function fieldPath({ entry, member }: Place, field: string): string {
  const path = `stack.layers.${entry}`;
  return member === undefined ? `${path}.${field}` : `${path}.layers.${member}.${field}`;
}

export function layerAt(spec: SpecDocument, { entry, member }: Place): Layer {
  const found = spec.stack.layers[entry];
  const layer = found && isGroup(found) ? found.layers[member ?? 0] : found;
  if (!layer || isGroup(layer)) throw new Error(`expected a layer at ${entry}, found none`);
  return layer;
}

export function setLayer(place: Place, fields: Partial<Layer>): Change {
  return (spec) => withEntry(spec, place.entry, (entry) => changedLayer(entry, place.member, fields));
}

export function setRepeat(entry: number, repeat: number): Change {
  return (spec) => withEntry(spec, entry, (group) => ({ ...group, repeat }) as Group);
}

/** Put a layer in, before the one that lies there now. */
export function addLayer(at: number, layer: Layer): Change {
  return (spec) => withLayers(spec, (layers) => layers.toSpliced(at, 0, layer));
}

export function removeLayer({ entry, member }: Place): Change {
  return (spec) => {
    const group = spec.stack.layers[entry];
    if (member === undefined || !group || !isGroup(group) || group.layers.length === 1) {
      return removeEntry(entry)(spec);
    }
    return withEntry(spec, entry, () => ({ ...group, layers: group.layers.toSpliced(member, 1) }));
  };
}

export function removeEntry(at: number): Change {
  return (spec) => withLayers(spec, (layers) => layers.toSpliced(at, 1));
}

/** Move an entry of the stack, a layer or a group, to another index. */
export function moveEntry(from: number, to: number): Change {
  return (spec) =>
    withLayers(spec, (layers) => {
      const moved = layers[from];
      return moved === undefined ? layers : layers.toSpliced(from, 1).toSpliced(to, 0, moved);
    });
}

/** Move a layer within its group; beyond its ends it leaves the group, unless it is the only one there. */
export function moveMember({ entry, member = 0 }: Place, by: -1 | 1): Change {
  return (spec) => {
    const group = spec.stack.layers[entry];
    if (!group || !isGroup(group)) return spec;
    const moved = group.layers[member];
    if (!moved) return spec;
    const others = group.layers.toSpliced(member, 1);
    const to = member + by;
    if (to >= 0 && to < group.layers.length) {
      return withEntry(spec, entry, () => ({ ...group, layers: others.toSpliced(to, 0, moved) }));
    }
    if (others.length === 0) return spec;
    const left = { ...group, layers: others };
    return withLayers(spec, (layers) => layers.toSpliced(entry, 1, ...(by < 0 ? [moved, left] : [left, moved])));
  };
}

/** Put a layer right behind another, into the same group where that is in one. */
export function insertAfter({ entry, member }: Place, layer: Layer): Change {
  if (member === undefined) return addLayer(entry + 1, layer);
  return (spec) =>
    withEntry(spec, entry, (group) =>
      isGroup(group) ? { ...group, layers: group.layers.toSpliced(member + 1, 0, layer) } : group,
    );
}

/** Make a layer a group, or put it into the group before it. */
export function groupLayer(at: number): Change {
  return (spec) =>
    withLayers(spec, (layers) => {
      const [layer, before] = [layers[at], layers[at - 1]];
      if (!layer || isGroup(layer)) return layers;
      if (before && isGroup(before)) {
        return layers.toSpliced(at - 1, 2, { ...before, layers: [...before.layers, layer] });
      }
      return layers.toSpliced(at, 1, { repeat: 2, layers: [layer] });
    });
}

/** Leave a group's layers in the stack, once. */
export function ungroup(at: number): Change {
  return (spec) =>
    withLayers(spec, (layers) => {
      const group = layers[at];
      return group && isGroup(group) ? layers.toSpliced(at, 1, ...group.layers) : layers;
    });
}

export function setMedium(medium: Medium, material: Material): Change {
  return (spec) => ({ ...spec, stack: { ...spec.stack, [medium]: material } });
}

export function setName(name: string): Change {
  return (spec) => ({ ...spec, name });
}

export function setSurface(fields: Partial<Surface> | null): Change {
  return (spec) => ({ ...spec, surface: fields && { ...spec.surface, ...fields } });
}

export function setTable(fields: Partial<Table>): Change {
  return (spec) => ({ ...spec, table: { ...spec.table, ...fields } });
}

export function setColour(fields: Partial<NonNullable<SpecDocument["colour"]>>): Change {
  return (spec) => ({ ...spec, colour: { ...spec.colour, ...fields } });
}

function withLayers(spec: SpecDocument, change: (layers: Entry[]) => Entry[]): SpecDocument {
  return { ...spec, stack: { ...spec.stack, layers: change(spec.stack.layers) } };
}

function withEntry(spec: SpecDocument, at: number, change: (entry: Entry) => Entry): SpecDocument {
  return withLayers(spec, (layers) => layers.map((entry, index) => (index === at ? change(entry) : entry)));
}

function changedLayer(entry: Entry, member: number | undefined, fields: Partial<Layer>): Entry {
  if (!isGroup(entry)) return { ...entry, ...fields };
  const layers = entry.layers.map((layer, index) => (index === (member ?? 0) ? { ...layer, ...fields } : layer));
  return { ...entry, layers };
}
