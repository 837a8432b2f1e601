/** An arm whose printed kernels are called with named values; q is a configuration (n), rad and m. */

import type { Joint, Vector } from "../viewer/scene";
import type { PrintedKernel, PrintedKernels } from "./data";
import { splitRows, type Rows } from "./small_matrices";

export type Values = ArrayLike<number>;
export const GENERIC_JOINTS = 9; // of the kernels for any arm, as in build.py

export class ArmModel {
  readonly jointCount: number;
  /** Number of joints minus the number of task rows, at least 0. */
  readonly redundancy: number;
  /** Limits of each joint, infinite where there is none. */
  readonly lower: Float64Array;
  readonly upper: Float64Array;
  /** Number of joints of the kernels: those that the arm does not have follow its own. */
  private readonly width: number;

  /** `taskRows` (m x 6) select from a twist in the world, linear part first. */
  constructor(readonly kernels: PrintedKernels, readonly joints: Joint[], readonly taskRows: number[][]) {
    this.jointCount = joints.length;
    this.width = kernels.geometry ? GENERIC_JOINTS : joints.length;
    this.redundancy = Math.max(0, joints.length - taskRows.length);
    this.lower = Float64Array.from(joints, (joint) => joint.low ?? -Infinity);
    this.upper = Float64Array.from(joints, (joint) => joint.high ?? Infinity);
  }

  /** Return 1 for each joint that can move, and 0 for each locked one. */
  freeJoints(locked: readonly number[]): Float64Array {
    const free = new Float64Array(this.jointCount).fill(1);
    for (const joint of locked) free[joint] = 0;
    return free;
  }

  /** Return the configuration within the limits that is nearest to q. */
  restrict = (q: Float64Array): Float64Array => q.map((value, k) => Math.min(this.upper[k], Math.max(this.lower[k], value)));

  /** Poses in the world of the base, the joints, and the tool, each of 12 numbers. */
  frames = (q: Values): Rows => splitRows(this.evaluate(this.kernels.frames, [q], 12 * (this.width + 2)), this.width + 2)
    .filter((_, frame) => frame <= this.jointCount || frame > this.width);

  /** Pose of the tool in the world, 12 numbers. */
  toolPose = (q: Values): Float64Array => this.evaluate(this.kernels.frames, [q], 12 * (this.width + 2)).subarray(-12);

  /** Position of the tool in the world, m. */
  toolPosition(q: Values): Vector {
    const pose = this.toolPose(q);
    return [pose[3], pose[7], pose[11]];
  }

  /** Rows of the Jacobian of the tool in the world (6 x n), linear rows first. */
  jacobian = (q: Values): Rows =>
    splitRows(this.evaluate(this.kernels.jacobian, [q], 6 * this.width), 6).map((row) => row.subarray(0, this.jointCount));

  /** Orthonormal basis of the null space of the task Jacobian: r joint velocities (each n). */
  nullSpace(q: Values): Rows {
    const columns = this.redundancy + this.width - this.jointCount;
    const entries = this.evaluate(this.kernels.nullSpace, [q], this.width * columns);
    const basis: Rows = [];
    for (let k = 0; k < this.redundancy; k++) {
      basis.push(new Float64Array(this.jointCount));
      for (let joint = 0; joint < this.jointCount; joint++) basis[k][joint] = entries[joint * columns + k];
    }
    return basis;
  }

  /**
   * Step towards a pose of the tool by the free joints (n, each 0 or 1), within the limits. The error is that before the step:
   * rad, and lengths in units of the arm's own length.
   */
  stepTowards(q: Values, target: Values, free: Values): { next: Float64Array; error: number } {
    const outputs = this.evaluate(this.kernels.inverseKinematicsStep, [q, target, free], this.width + 1);
    return { next: outputs.subarray(0, this.jointCount), error: outputs[this.width] };
  }

  /** Joint velocities (n) that a control law commands for a velocity of the tool point in the world, m/s. */
  commandRates = (law: string, q: Values, velocity: Values): Float64Array =>
    this.evaluate(this.kernels.laws[law], [q, velocity], this.width).subarray(0, this.jointCount);

  /** Accelerations (n) of an arm without torques; joints that are not free are held. */
  accelerations(q: Values, rates: Values, free: Values): Float64Array {
    if (this.kernels.accelerations === null) throw new Error("the arm has no inertial data, so its fall cannot be computed");
    return this.evaluate(this.kernels.accelerations, [q, rates, free], this.jointCount);
  }

  private evaluate(kernel: PrintedKernel, parts: Values[], outputCount: number): Float64Array {
    let offset = 0;
    for (const part of [...parts, this.kernels.geometry ?? []]) {
      const count = part.length === this.jointCount ? this.width : part.length;
      for (let k = 0; k < count; k++) inputs[offset + k] = k < part.length ? part[k] : 0;
      offset += count;
    }
    const outputs = new Float64Array(outputCount);
    kernel(inputs, outputs);
    return outputs;
  }
}

const inputs = new Float64Array(256); // of every kernel, one after the other
