/** Work of which only the newest counts: one at a time, and what is asked for meanwhile replaces what waits. */

export class Latest<Asked> {
  #running = false;
  #waiting: Asked | undefined;

  constructor(readonly work: (asked: Asked) => Promise<void>) {}

  /** Do this work, at once or after what is in hand; earlier work that still waits is left out. */
  ask(asked: Asked): void {
    this.#waiting = asked;
    if (!this.#running) void this.#run();
  }

  async #workOff(): Promise<void> {
    for (let asked = this.#waiting; asked !== undefined; asked = this.#waiting) {
      this.#waiting = undefined;
      await this.work(asked);
    }
  }

  /** Work that fails leaves the way free for what is asked for next. */
  async #run(): Promise<void> {
    this.#running = true;
    try {
      await this.#workOff();
    } finally {
      this.#running = false;
    }
  }
}
