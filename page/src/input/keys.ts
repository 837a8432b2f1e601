/** Arrow keys: full deflection while they are held, less with Shift. Page up and page down move the third axis. */

import type { Device } from "./device";

const SLOW = 0.4;
const KEYS: Record<string, [axis: number, sign: number]> = {
  ArrowRight: [0, 1],
  ArrowLeft: [0, -1],
  ArrowUp: [1, 1],
  ArrowDown: [1, -1],
  PageUp: [2, 1],
  PageDown: [2, -1],
};

export class Keys implements Device {
  readonly kind = "keys";
  private readonly held = new Set<string>();
  private slow = false;
  private readonly controller = new AbortController();

  constructor() {
    const { signal } = this.controller;
    window.addEventListener("keydown", (event) => this.down(event), { signal });
    window.addEventListener("keyup", (event) => this.up(event), { signal });
    // The release of a key elsewhere is never heard of.
    window.addEventListener("blur", () => this.held.clear(), { signal });
  }

  read(out: Float64Array): void {
    out.fill(0);
    for (const key of this.held) {
      const [axis, sign] = KEYS[key];
      if (axis < out.length) out[axis] += this.slow ? SLOW * sign : sign;
    }
  }

  release(): void {
    this.controller.abort();
  }

  private down(event: KeyboardEvent): void {
    this.slow = event.shiftKey;
    if (!(event.key in KEYS) || event.target instanceof HTMLInputElement) return;
    event.preventDefault(); // the page must not scroll
    this.held.add(event.key);
  }

  private up(event: KeyboardEvent): void {
    this.slow = event.shiftKey;
    this.held.delete(event.key);
  }
}
