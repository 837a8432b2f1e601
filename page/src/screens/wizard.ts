/** Calibration of a gamepad, step by step: release, push each way, press the button to start with. */

import { pushed, Readings, type AxisMap, type Calibration } from "../input/calibration";

const REST = 1.5; // s of stillness are watched
const HOLD = 0.6; // s of pushing

export class Wizard {
  result: Calibration | null = null;
  private readonly rest = new Readings();
  private readonly axes: AxisMap[] = [];
  private since: number | null = null;
  /** The largest push of this step. */
  private best: AxisMap | null = null;
  private letGo = true;

  constructor(private readonly count: number) {}

  /**
   * What the gamepad shows at a time, s.
   *
   * @returns key of the text that says what to do now
   */
  look(raw: readonly number[], buttons: readonly boolean[], now: number): string {
    this.since ??= now;
    if (this.axes.length === 0 && this.best === null && now - this.since < REST) {
      this.rest.add(raw);
      return "calibrate_rest";
    }
    if (this.axes.length < this.count) return this.push(raw, now);
    if (!this.released(raw)) return "calibrate_let_go";
    const pressed = buttons.indexOf(true);
    if (pressed >= 0) this.result = { axes: this.axes, start: [pressed] };
    return "calibrate_button";
  }

  private push(raw: readonly number[], now: number): string {
    if (!this.letGo) this.letGo = this.released(raw);
    if (!this.letGo) return "calibrate_let_go";
    const taken = this.axes.map((a) => a.axis);
    const seen = pushed(this.rest, raw, taken);
    if (seen === null) {
      this.best = null;
    } else if (this.best === null || this.best.axis !== seen.axis) {
      this.best = seen;
      this.since = now;
    } else {
      if (Math.abs(seen.range) > Math.abs(this.best.range)) this.best = seen;
      if (now - (this.since ?? now) >= HOLD) {
        this.axes.push(this.best);
        this.best = null;
        this.letGo = false;
      }
    }
    return `calibrate_axis_${Math.min(this.axes.length, this.count - 1) + 1}`;
  }

  /** Whether all axes that are known by now are near their rest. */
  private released(raw: readonly number[]): boolean {
    return this.axes.every((a) => Math.abs(raw[a.axis] - a.centre) < Math.max(a.noise, 0.25 * Math.abs(a.range)));
  }
}
