/** SurfacePanel */

export function SurfacePanel() {
  return null;
}
