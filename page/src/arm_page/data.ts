/** Data of a page of an arm, as JSON; holdfast/interface/presentation/arm_page/build.py writes them. */

import type { Scene, Vector } from "../viewer/scene";

/** A printed kernel reads its inputs from the first array and writes its outputs to the second. */
export type PrintedKernel = (inputs: Float64Array, outputs: Float64Array) => void;

/** The kernels of an arm with n joints, m task rows, and r = n - m; matrices are stored row by row. */
export interface PrintedKernels {
  /** Geometry of an arm whose kernels are for any arm with at most `GENERIC_JOINTS` joints: the last input of each kernel. */
  geometry?: Float64Array;
  /** q (n) to n + 2 poses of 12 numbers in the world: base, joints, tool. */
  frames: PrintedKernel;
  /** q (n) to the Jacobian of the tool in the world (6 x n), linear rows first. */
  jacobian: PrintedKernel;
  /** q (n) to an orthonormal basis N of the null space of the task Jacobian (n x r). */
  nullSpace: PrintedKernel;
  /** q (n), target pose (12), free joints (n, each 0 or 1) to the next q (n) and the error at q (1), rad and arm lengths. */
  inverseKinematicsStep: PrintedKernel;
  /** For each control law: q (n), velocity of the tool point in the world (3) to joint velocities (n). */
  laws: Record<string, PrintedKernel>;
  /** q (n), joint velocities (n), free joints (n, each 0 or 1) to joint accelerations (n); null without masses. */
  accelerations: PrintedKernel | null;
}

/** A law in the story of the undetected lock. */
export interface StoryLaw {
  /** Key in `PrintedKernels.laws`. */
  slug: string;
  name: string;
}

/** The story that Python has prepared for an arm. */
export interface Story {
  /** A configuration with much to gain along its self-motion. */
  start: number[];
  /** Target position of the tool for the undetected lock, m. */
  target: Vector;
  laws: [StoryLaw, StoryLaw];
  /** Proportional gain, 1/s, and the maximum speed of the tool, m/s. */
  gain: number;
  speed: number;
  /** Number of random motions that were simulated. */
  motions: number;
  /** Median deviations from the straight line, m: law 1, law 2, and law 1 from the prepared start. */
  deviations: [number, number, number];
}

export interface ArmPageData {
  name: string;
  /** What a command calls the arm, with its options, and the Python expression that loads it. */
  argument: string;
  pythonArm: string;
  scene: Scene;
  /** How a sentence names each joint, for example "joint 4". */
  jointLabels: string[];
  /** Rows of the task (m x 6) that select from a twist in the world, linear part first. */
  taskRows: number[][];
  taskName: string;
  /** Task of the undetected lock: position, or planar for an arm that moves in a plane. */
  positionTask: string;
  /** Upper bound of the worst relative manipulability of any arm with this n and m. */
  bound: number;
  /** Acceleration of gravity in the world, m/s^2. */
  gravity: Vector;
  story: Story | null;
  /** Texts by key, from en.yaml. */
  texts: Record<string, string>;
}
