/** Time slider of motions, and a button that plays them. */

import { h } from "./dom";

const SHORTEST_PAUSE_MS = 30; // between two pictures

export class Player {
  /** Shown time, in the unit of the motion. */
  time = 0;
  readonly input = h("input", { type: "range", min: 0, step: "any" });
  readonly button = h("button", { type: "button", onclick: () => this.play() });
  readonly readout = h("output");
  private duration = 0;
  private speed = 1;
  private timer = 0;

  /** `texts` are those of button and slider, `format` writes a time, and `show` is called after a change of the time. */
  constructor(
    private readonly texts: { play?: string; pause?: string; time?: string },
    private readonly format: (time: number) => string,
    private readonly show: () => void,
  ) {
    this.input.setAttribute("aria-label", texts.time ?? "");
    this.input.addEventListener("input", () => {
      this.stop();
      this.showTime(this.input.valueAsNumber);
    });
    this.stop();
  }

  get playing(): boolean {
    return this.timer !== 0;
  }

  /** Set the end of the motion, and the shown time per second of playing. */
  setRange(duration: number, speed: number): void {
    this.stop();
    [this.duration, this.speed] = [duration, speed];
    this.input.max = String(duration);
  }

  showTime(time: number): void {
    this.time = Math.min(time, this.duration);
    this.input.value = String(this.time);
    this.readout.textContent = this.format(this.time);
    this.input.setAttribute("aria-valuetext", this.readout.textContent);
    this.show();
  }

  stop(): void {
    cancelAnimationFrame(this.timer);
    this.timer = 0;
    this.button.textContent = this.texts.play ?? "";
  }

  /** Play from the shown time, or from the beginning at the end; pause while playing. */
  play(): void {
    if (this.playing) return this.stop();
    const from = this.time >= this.duration ? 0 : this.time;
    let [begun, before] = [0, 0];
    const tick = (now: number): void => {
      begun ||= now;
      this.timer = requestAnimationFrame(tick);
      const time = Math.min(this.duration, from + (this.speed * (now - begun)) / 1000);
      if (now - before < SHORTEST_PAUSE_MS && time < this.duration) return;
      before = now;
      this.showTime(time);
      if (time >= this.duration) this.stop();
    };
    this.button.textContent = this.texts.pause ?? "";
    this.timer = requestAnimationFrame(tick);
  }
}
