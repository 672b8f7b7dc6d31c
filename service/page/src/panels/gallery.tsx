/** Gallery */

export function Gallery() {
  return null;
}
