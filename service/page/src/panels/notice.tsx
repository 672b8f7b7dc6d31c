/** Notice */

export function Notice() {
  return null;
}
