/** Time slider of motions, and a button that plays them. */

import { h } from "./dom";

export interface PlayerOptions {
  /** Texts of the button, before and while it plays, and of the slider. */
  texts: { play?: string; pause?: string; time?: string };
  /** Called after a change of the shown time. */
  show: () => void;
  /** Text for a time. */
  format?: (time: number) => string;
}

const SHORTEST_PAUSE_MS = 30; // between two pictures

export class Player {
  /** Shown time, in the unit of the motion. */
  time = 0;
  readonly input = h("input", { type: "range", min: 0, step: "any" });
  readonly button = h("button", { type: "button", onclick: () => this.play() });
  readonly readout = h("output", { class: "view3d-said" });
  private duration = 0;
  private speed = 1;
  private unit = "s";
  private timer = 0;

  constructor(private readonly options: PlayerOptions) {
    this.input.setAttribute("aria-label", options.texts.time ?? "");
    this.input.addEventListener("input", () => {
      this.stop();
      this.showTime(Number(this.input.value));
    });
    this.button.textContent = options.texts.play ?? "";
  }

  get playing(): boolean {
    return this.timer !== 0;
  }

  /** Set the end of the motion, and the shown time per second of playing. */
  setRange(duration: number, speed: number, unit = "s"): void {
    this.stop();
    [this.duration, this.speed, this.unit] = [duration, speed, unit];
    this.input.max = String(duration);
  }

  /** Set the time without a call of `show`. */
  setTime(time: number): void {
    this.time = Math.min(time, this.duration);
    const text = this.options.format?.(this.time) ?? `${this.time.toFixed(this.duration < 20 ? 1 : 0)} ${this.unit}`;
    this.input.value = String(this.time);
    if (this.readout.textContent === text) return;
    this.readout.textContent = text;
    this.input.setAttribute("aria-valuetext", text);
  }

  showTime(time: number): void {
    this.setTime(time);
    this.options.show();
  }

  stop(): void {
    cancelAnimationFrame(this.timer);
    this.timer = 0;
    this.button.textContent = this.options.texts.play ?? "";
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
    this.button.textContent = this.options.texts.pause ?? "";
    this.timer = requestAnimationFrame(tick);
  }
}
