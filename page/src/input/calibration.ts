/** From the raw axes and buttons of a gamepad to deflections: pure arithmetic, so that it can be tested. */

export interface AxisMap {
  /** Index of the axis on the gamepad. */
  axis: number;
  /** Raw reading at rest. */
  centre: number;
  /** Raw reading at full deflection, less the centre; its sign is the direction. */
  range: number;
  /** Raw deflections up to this value are noise. */
  noise: number;
}

export interface Calibration {
  axes: AxisMap[];
  /** Buttons that start a trial. */
  start: number[];
}

/** Left stick, up is negative; the right stick moves the third axis; the first button and the triggers start. */
export function standard(count: number): Calibration {
  const range = [1, -1, -1];
  const axis = [0, 1, 3];
  const axes = Array.from({ length: count }, (_, i) => ({ axis: axis[i], centre: 0, range: range[i], noise: 0 }));
  return { axes, start: [0, 4, 5, 6, 7] };
}

/** The deflections, -1 to 1, into `out`. */
export function deflection(calibration: Calibration, raw: readonly number[], out: Float64Array): void {
  for (let i = 0; i < out.length; i++) {
    const map = calibration.axes[i];
    const away = (raw[map.axis] ?? 0) - map.centre;
    out[i] = Math.abs(away) <= map.noise ? 0 : Math.max(-1, Math.min(1, away / map.range));
  }
}

/** Readings of all axes over a while. */
export class Readings {
  private readonly low: number[] = [];
  private readonly high: number[] = [];
  private readonly sum: number[] = [];
  count = 0;

  add(raw: readonly number[]): void {
    this.count += 1;
    raw.forEach((value, i) => {
      this.low[i] = Math.min(this.low[i] ?? value, value);
      this.high[i] = Math.max(this.high[i] ?? value, value);
      this.sum[i] = (this.sum[i] ?? 0) + value;
    });
  }

  /** The value of an axis at rest, and how far it strays: one and a half times what was seen. */
  rest(axis: number): { centre: number; noise: number } {
    const centre = (this.sum[axis] ?? 0) / Math.max(1, this.count);
    const strays = Math.max((this.high[axis] ?? 0) - centre, centre - (this.low[axis] ?? 0));
    return { centre, noise: Math.min(0.5, 1.5 * strays) };
  }
}

/** Smallest deflection that selects an axis. */
const MEANT = 0.5;

/** Which axis was pushed, seen from its rest, and how far with its sign; null if none was, or one that is taken. */
export function pushed(rest: Readings, raw: readonly number[], taken: readonly number[]): AxisMap | null {
  let found: AxisMap | null = null;
  raw.forEach((value, axis) => {
    const { centre, noise } = rest.rest(axis);
    const range = value - centre;
    const larger = Math.abs(range) > Math.max(MEANT, Math.abs(found?.range ?? 0));
    if (larger && !taken.includes(axis)) found = { axis, centre, range, noise };
  });
  return found;
}
