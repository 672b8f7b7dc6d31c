/** When to draw and how finely: on demand, and only as finely as the machine keeps up with while things move. */

const REST_MS = 160;
const MOVING_FRAME_MS = 45;
const RATIOS = [1, 0.75, 0.5] as const;
const ROUGHEST = 0.35;
const MOST_PIXELS = 2; // per CSS pixel and axis

/** Whether more is to be drawn: a better picture of the same, or of what moves. */
export type Mood = "still" | "moving";

/** Draws a frame so many device pixels per CSS pixel finely; done once the GPU is. */
export type Draw = (pixelRatio: number, mood: Mood) => Promise<void>;

export class Pace {
  #asked = false;
  #drawing = false;
  #rest: ReturnType<typeof setTimeout> | undefined;
  #isMoving = false;
  #fullMs = 200; // until a frame has been measured: rather coarse than late

  constructor(readonly draw: Draw, readonly onMood: (mood: Mood) => void) {}

  /** Draw finely. */
  still(): void {
    clearTimeout(this.#rest);
    this.#isMoving = false;
    this.#ask();
  }

  /** Draw quickly, and finely once nothing has moved for a while. */
  moving(): void {
    clearTimeout(this.#rest);
    this.#isMoving = true;
    this.#rest = setTimeout(() => this.still(), REST_MS);
    this.#ask();
  }

  stop(): void {
    clearTimeout(this.#rest);
    this.#asked = false;
  }

  #ask(): void {
    this.#asked = true;
    this.onMood("moving");
    if (this.#drawing) return;
    this.#drawing = true;
    requestAnimationFrame(() => void this.#run());
  }

  async #run(): Promise<void> {
    try {
      while (this.#asked) {
        this.#asked = false;
        await this.#drawOnce();
      }
    } finally {
      this.#drawing = false; // a frame that failed is no reason to draw none again
    }
    if (!this.#isMoving) this.onMood("still");
  }

  async #drawOnce(): Promise<void> {
    const finest = Math.min(devicePixelRatio, MOST_PIXELS);
    const share = this.#isMoving ? this.#affordable() : 1;
    const start = performance.now();
    await this.draw(finest * share, this.#isMoving ? "moving" : "still");
    this.#measure((performance.now() - start) / share ** 2);
  }

  /** The finest ratio whose pixels are drawn in time, from what the last frames took. */
  #affordable(): number {
    return RATIOS.find((ratio) => this.#fullMs * ratio ** 2 <= MOVING_FRAME_MS) ?? ROUGHEST;
  }

  /** The mean of the last few. A frame that compiles says little, and one with nothing to draw says nothing. */
  #measure(fullMs: number): void {
    if (fullMs > 1) this.#fullMs = 0.6 * this.#fullMs + 0.4 * Math.min(fullMs, 400);
  }
}
