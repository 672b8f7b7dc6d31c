/** Layers */

export function Layers() {
  return null;
}
