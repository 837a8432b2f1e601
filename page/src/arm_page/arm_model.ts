/** An arm whose printed kernels are called with named values; q is a configuration (n), rad and m. */

import type { Joint, Vector } from "../viewer/scene";
import type { PrintedKernel, PrintedKernels } from "./data";
import { splitRows, type Rows } from "./small_matrices";

export type Values = ArrayLike<number>;

/** A step of the inverse kinematics. */
export interface KinematicStep {
  next: Float64Array;
  /** Norm of the error before the step: rad, and lengths in units of the arm's own length. */
  error: number;
}

export class ArmModel {
  readonly jointCount: number;
  /** Number of joints minus the number of task rows, at least 0. */
  readonly redundancy: number;
  /** Limits of each joint, infinite where there is none. */
  readonly lower: Float64Array;
  readonly upper: Float64Array;

  /** `taskRows` (m x 6) select from a twist in the world, linear part first. */
  constructor(readonly kernels: PrintedKernels, readonly joints: Joint[], readonly taskRows: number[][]) {
    this.jointCount = joints.length;
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
  frames = (q: Values): Rows => splitRows(evaluate(this.kernels.frames, [q], 12 * (this.jointCount + 2)), this.jointCount + 2);

  /** Pose of the tool in the world, 12 numbers. */
  toolPose = (q: Values): Float64Array => evaluate(this.kernels.frames, [q], 12 * (this.jointCount + 2)).subarray(-12);

  /** Position of the tool in the world, m. */
  toolPosition(q: Values): Vector {
    const pose = this.toolPose(q);
    return [pose[3], pose[7], pose[11]];
  }

  /** Rows of the Jacobian of the tool in the world (6 x n), linear rows first. */
  jacobian = (q: Values): Rows => splitRows(evaluate(this.kernels.jacobian, [q], 6 * this.jointCount), 6);

  /** Orthonormal basis of the null space of the task Jacobian: r joint velocities (each n). */
  nullSpace(q: Values): Rows {
    const entries = evaluate(this.kernels.nullSpace, [q], this.jointCount * this.redundancy);
    const basis: Rows = [];
    for (let k = 0; k < this.redundancy; k++) {
      basis.push(new Float64Array(this.jointCount));
      for (let joint = 0; joint < this.jointCount; joint++) basis[k][joint] = entries[joint * this.redundancy + k];
    }
    return basis;
  }

  /** Step towards a pose of the tool by the free joints (n, each 0 or 1), within the limits. */
  stepTowards(q: Values, target: Values, free: Values): KinematicStep {
    const outputs = evaluate(this.kernels.inverseKinematicsStep, [q, target, free], this.jointCount + 1);
    return { next: outputs.subarray(0, this.jointCount), error: outputs[this.jointCount] };
  }

  /** Joint velocities (n) that a control law commands for a velocity of the tool point in the world, m/s. */
  commandRates = (law: string, q: Values, velocity: Values): Float64Array =>
    evaluate(this.kernels.laws[law], [q, velocity], this.jointCount);

  /** Accelerations (n) of an arm without torques; joints that are not free are held. */
  accelerations(q: Values, rates: Values, free: Values): Float64Array {
    if (this.kernels.accelerations === null) throw new Error("the arm has no inertial data, so its fall cannot be computed");
    return evaluate(this.kernels.accelerations, [q, rates, free], this.jointCount);
  }
}

const inputs = new Float64Array(256); // of every kernel, one after the other

function evaluate(kernel: PrintedKernel, parts: Values[], outputCount: number): Float64Array {
  let offset = 0;
  for (const part of parts) {
    for (let k = 0; k < part.length; k++) inputs[offset + k] = part[k];
    offset += part.length;
  }
  const outputs = new Float64Array(outputCount);
  kernel(inputs, outputs);
  return outputs;
}
