/** The text attributes in the header of a single-part OpenEXR file ("OpenEXR File Layout", openexr.com). */

const MAGIC = 20000630;
const VERSION_BYTES = 8;

/**
 * Read the attributes of type string by name.
 *
 * three's loader reads them too, but searches without end for the end of a header that is cut off.
 *
 * @throws Error if the bytes are not an OpenEXR file, or its header is incomplete.
 */
export function readTextAttributes(file: ArrayBuffer): ReadonlyMap<string, string> {
  const bytes = new Uint8Array(file);
  const view = new DataView(file);
  if (file.byteLength < VERSION_BYTES || view.getUint32(0, true) !== MAGIC) {
    throw new Error("expected an OpenEXR file, found other bytes");
  }
  const attributes = new Map<string, string>();
  for (let at = VERSION_BYTES; bytes[at] !== 0; ) {
    const nameEnd = end(bytes, at);
    const typeEnd = end(bytes, nameEnd + 1);
    const value = typeEnd + 5;
    if (value > file.byteLength) throw cutOff();
    const next = value + view.getUint32(typeEnd + 1, true);
    if (next >= file.byteLength) throw cutOff();
    const isText = text(bytes, nameEnd + 1, typeEnd) === "string";
    if (isText) attributes.set(text(bytes, at, nameEnd), text(bytes, value, next));
    at = next;
  }
  return attributes;
}

/** Where the zero is that ends a name. */
function end(bytes: Uint8Array, from: number): number {
  const zero = bytes.indexOf(0, from);
  if (zero < 0) throw cutOff();
  return zero;
}

function text(bytes: Uint8Array, from: number, to: number): string {
  return new TextDecoder().decode(bytes.subarray(from, to));
}

function cutOff(): Error {
  return new Error("the OpenEXR file is damaged: its header is cut off");
}
