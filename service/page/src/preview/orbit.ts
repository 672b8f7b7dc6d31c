/** Where the camera stands: on a sphere around the shape. */

import { MathUtils, type PerspectiveCamera } from "three";

interface Place {
  readonly azimuthDegrees: number;
  readonly elevationDegrees: number;
}

const HOME: Place = { azimuthDegrees: 0, elevationDegrees: 12 };
const HIGHEST_DEGREES = 80;
const LOWEST_DEGREES = -15; // below that the ground would hide what stands on it
const RADIUS = 1.3; // of all that is to be seen
const FIELD_DEGREES = 26;

export class Orbit {
  #place = HOME;

  constructor(readonly camera: PerspectiveCamera) {
    this.#stand();
  }

  turn(azimuthDegrees: number, elevationDegrees: number): void {
    const elevation = MathUtils.clamp(this.#place.elevationDegrees + elevationDegrees, LOWEST_DEGREES, HIGHEST_DEGREES);
    this.#place = { azimuthDegrees: this.#place.azimuthDegrees + azimuthDegrees, elevationDegrees: elevation };
    this.#stand();
  }

  reset(): void {
    this.#place = HOME;
    this.#stand();
  }

  /** Look at the whole shape, however wide or high the picture is. */
  frame(aspect: number): void {
    this.camera.aspect = aspect;
    const narrower = Math.min(aspect, 1);
    this.camera.fov = MathUtils.radToDeg(2 * Math.atan(Math.tan(MathUtils.degToRad(FIELD_DEGREES / 2)) / narrower));
    this.camera.updateProjectionMatrix();
  }

  /** What a reader of pixels must know of the camera. */
  get facts(): string {
    const { position, fov } = this.camera;
    return JSON.stringify({ position: position.toArray(), fieldDegrees: fov });
  }

  #stand(): void {
    const distance = RADIUS / Math.sin(MathUtils.degToRad(FIELD_DEGREES / 2));
    const phi = MathUtils.degToRad(90 - this.#place.elevationDegrees);
    this.camera.position.setFromSphericalCoords(distance, phi, MathUtils.degToRad(this.#place.azimuthDegrees));
    this.camera.lookAt(0, 0, 0);
  }
}
