/** Turning by a pointer, by touch and by keys. */

interface Turned {
  turn(azimuthDegrees: number, elevationDegrees: number): void;
  reset(): void;
}

const DEGREES_PER_PIXEL = 0.5;
const DEGREES_PER_KEY = 7.5;

const KEYS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** Turn by what is done on an element, until `signal` aborts. */
export function turnBy(element: HTMLElement, turned: Turned, signal: AbortSignal): void {
  element.addEventListener("pointermove", (event) => drag(event, turned), { signal });
  element.addEventListener("pointerdown", (event) => element.setPointerCapture(event.pointerId), { signal });
  element.addEventListener("dblclick", () => turned.reset(), { signal });
  element.addEventListener("keydown", (event) => press(event, turned), { signal });
}

function drag(event: PointerEvent, turned: Turned): void {
  if (event.buttons !== 1) return;
  const elevation = event.pointerType === "touch" ? 0 : event.movementY; // a finger that goes up or down scrolls
  turned.turn(-event.movementX * DEGREES_PER_PIXEL, elevation * DEGREES_PER_PIXEL);
}

function press(event: KeyboardEvent, turned: Turned): void {
  const direction = KEYS[event.key];
  if (event.ctrlKey || event.metaKey || event.altKey || (!direction && event.key !== "Home")) return;
  event.preventDefault();
  if (!direction) return turned.reset();
  turned.turn(direction[0] * DEGREES_PER_KEY, direction[1] * DEGREES_PER_KEY);
}
