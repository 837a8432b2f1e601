/**
 * The stick: rate control, as `holdfast.teleop.trials.Joystick`. The commanded velocity is proportional to the deflection outside
 * the dead zone, and nothing is rescaled there. The arithmetic is the Python one, operation by operation: a recording made here
 * is replayed there.
 */

/** Euclidean length as NumPy computes it: the root of the sum of squares, from the first to the last. */
export function norm(v: ArrayLike<number>): number {
  let sum = 0;
  for (let i = 0; i < v.length; i++) sum += v[i] * v[i];
  return Math.sqrt(sum);
}

export class Stick {
  /**
   * @param limit largest speed, m/cycle, at full deflection
   * @param deadZone m/cycle: slower commands are none
   */
  constructor(readonly limit: number, readonly deadZone: number) {}

  /** Commanded velocity, m/cycle, into `out`, for a deflection of -1 to 1 on each axis. */
  velocity(deflection: ArrayLike<number>, out: Float64Array): void {
    for (let i = 0; i < out.length; i++) out[i] = this.limit * deflection[i];
    const speed = norm(out);
    const slower = speed > this.limit ? this.limit / speed : 1;
    for (let i = 0; i < out.length; i++) out[i] = speed < this.deadZone ? 0 : out[i] * slower;
  }
}
