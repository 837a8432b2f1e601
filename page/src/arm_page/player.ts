/** Time slider of motions, and a button that plays them. */

import { h } from "../dom";

const LONGEST_PLAY_S = 15;

export interface PlayerOptions {
  /** Texts of the button and of the slider. */
  texts: Record<string, string>;
  /** Shown time per second of playing, or more for a long motion. */
  speed: number;
  show: () => void;
}

export class Player {
  /** Shown time, in the unit of the motion. */
  time = 0;
  readonly element: HTMLElement;
  private duration = 0;
  private speed = 1;
  private unit = "s";
  private timer = 0;
  private readonly input = h("input", { type: "range", min: 0, step: "any" });
  private readonly button = h("button", { type: "button", onclick: () => this.play() });
  private readonly readout = h("output");

  constructor(private readonly options: PlayerOptions) {
    this.input.setAttribute("aria-label", options.texts.time);
    this.input.addEventListener("input", () => {
      this.stop();
      this.showTime(Number(this.input.value));
    });
    this.button.textContent = options.texts.play;
    this.element = h("label", { class: "player" }, this.button, this.input, this.readout);
  }

  get playing(): boolean {
    return this.timer !== 0;
  }

  /** Set the end of the motion, and show a time. */
  open(duration: number, time = duration, unit = "s"): void {
    this.stop();
    [this.duration, this.unit] = [duration, unit];
    this.speed = Math.max(this.options.speed, duration / LONGEST_PLAY_S);
    this.input.max = String(duration);
    this.showTime(Math.min(time, duration));
  }

  showTime(time: number): void {
    this.time = time;
    this.input.value = String(time);
    this.readout.textContent = `${time.toFixed(this.duration < 20 ? 1 : 0)} ${this.unit}`;
    this.input.setAttribute("aria-valuetext", this.readout.textContent);
    this.options.show();
  }

  stop(): void {
    cancelAnimationFrame(this.timer);
    this.timer = 0;
    this.button.textContent = this.options.texts.play;
  }

  /** Play from the shown time, or from the beginning at the end; pause while playing. */
  play(): void {
    if (this.playing) return this.stop();
    const from = this.time >= this.duration ? 0 : this.time;
    let begun = 0;
    const tick = (now: number): void => {
      begun ||= now;
      this.showTime(Math.min(this.duration, from + (this.speed * (now - begun)) / 1000));
      if (this.time >= this.duration) this.stop();
      else this.timer = requestAnimationFrame(tick);
    };
    this.button.textContent = this.options.texts.pause;
    this.timer = requestAnimationFrame(tick);
  }
}
