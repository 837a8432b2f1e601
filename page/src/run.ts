/**
 * One trial under way: `holdfast.teleop.trials.drive_trials` for a single arm, with a protocol's rules. In each cycle the
 * command is read, then the checks are made, then the arm moves: recordings replay exactly because the order is the same.
 */

import type { Arm } from "./arm";
import type { Experiment } from "./experiment";
import type { EndMessage, PlannedTrial } from "./messages";
import { norm, type Stick } from "./stick";

export type Ending = EndMessage["end"];

/** Control law, start, target, m, and locked joint of a trial. */
export type Task = Omit<PlannedTrial, "task">;

export type Rules = Pick<Experiment, "radius" | "cycle_limit">;

export class Run {
  /** Cycles done. */
  cycles = 0;
  /** Configuration now: at the end of the last cycle. */
  readonly q: Float64Array;
  /** Configuration when the last cycle began. */
  readonly before: Float64Array;
  /** Command of the last cycle, m/cycle. */
  readonly velocity: Float64Array;
  /** Tool point now, m. */
  readonly x: Float64Array;
  private readonly target: Float64Array;
  private readonly healthy: Float64Array;
  private readonly out: Float64Array;

  constructor(
    private readonly arm: Arm,
    private readonly task: Task,
    private readonly stick: Stick,
    private readonly rules: Rules,
  ) {
    this.q = Float64Array.from(task.q0);
    this.before = Float64Array.from(task.q0);
    this.target = Float64Array.from(task.target);
    this.velocity = new Float64Array(arm.axes);
    this.x = new Float64Array(arm.axes);
    this.out = new Float64Array(arm.joints + arm.axes);
    this.healthy = new Float64Array(arm.joints).fill(1);
    if (task.joint >= 0) this.healthy[task.joint] = 0;
    arm.position(this.q, this.x);
  }

  /** One control cycle; the ending, if the trial is over instead. */
  step(deflection: ArrayLike<number>, abort: boolean): Ending | null {
    this.stick.velocity(deflection, this.velocity);
    const over = this.checked(abort);
    if (over !== null) return over;
    this.before.set(this.q);
    this.arm.cycle(this.task.law, this.q, this.velocity, this.healthy, this.out);
    this.q.set(this.out.subarray(0, this.arm.joints));
    this.arm.position(this.q, this.x);
    this.cycles += 1;
    return null;
  }

  /** True if the tool point is inside the target circle. */
  get inside(): boolean {
    return norm(this.target.map((v, i) => v - this.x[i])) <= this.rules.radius;
  }

  private checked(abort: boolean): Ending | null {
    if (abort) return "aborted";
    if (this.inside && this.velocity.every((v) => v === 0)) return "arrived";
    return this.rules.cycle_limit !== null && this.cycles >= this.rules.cycle_limit ? "time" : null;
  }
}
