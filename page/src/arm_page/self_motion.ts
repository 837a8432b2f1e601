/** Self-motion of an arm: the configurations with the same pose of the tool. */

import type { ArmModel, Values } from "./arm_model";
import { relativeManipulability } from "./failures";
import { addScaled, dotProduct, vectorNorm } from "./small_matrices";
import { reachTarget } from "./tool_drag";

const STEP_RAD = 0.03;
const LEAST_STEP_RAD = 1e-4;
const LEAST_SLOPE = 1e-9;
const MAX_STEPS = 1000;
const MAX_CORRECTORS = 8;
/** A step is halved if it moves the arm by less than this fraction of its length, or if the direction turns by more. */
const LEAST_PROGRESS = 0.4;
const LEAST_COSINE = 0.7;
/** Distance from q, in steps, within which the motion has returned to q. */
const RETURN_STEPS = 0.75;

export type MotionEnd = "limit" | "no progress" | "closed loop" | "length";

export interface SelfMotion {
  /** Configurations in the order of the motion, and the smallest relative manipulability at each. */
  configurations: Float64Array[];
  worst: number[];
  /** Index of the start in the configurations, and of the configuration with the largest worst case. */
  start: number;
  best: number;
  /** Reasons for which the motion ends before its first and after its last configuration. */
  ends: [MotionEnd, MotionEnd];
}

const worstCase = (arm: ArmModel, q: Values): number => Math.min(...relativeManipulability(arm, q));

/**
 * Trace the self-motion both ways from q: all of it for an arm with one redundant joint, otherwise the part along a vector of
 * the basis of the null space, or without one along the projected gradient of the worst case, where it rises and where it falls.
 */
export function traceSelfMotion(arm: ArmModel, q: Values, column: number | null = null): SelfMotion {
  const start = Float64Array.from(q);
  const target = arm.toolPose(start);
  const forward = traceOneWay(arm, start, target, 1, column);
  const isLoop = forward.end === "closed loop";
  const backward: OneWay = isLoop ? { configurations: [], end: "closed loop" } : traceOneWay(arm, start, target, -1, column);
  const configurations = [...backward.configurations.reverse(), start, ...forward.configurations];
  const worst = configurations.map((configuration) => worstCase(arm, configuration));
  return {
    configurations,
    worst,
    start: backward.configurations.length,
    best: worst.indexOf(Math.max(...worst)),
    ends: [backward.end, forward.end],
  };
}

interface OneWay {
  configurations: Float64Array[];
  end: MotionEnd;
}

function traceOneWay(arm: ArmModel, start: Float64Array, target: Float64Array, sign: number, column: number | null): OneWay {
  const configurations: Float64Array[] = [];
  let [q, previous]: [Float64Array, Float64Array | null] = [start, null];
  while (configurations.length < MAX_STEPS) {
    const tangent = selfMotionDirection(arm, q, sign, previous, arm.redundancy === 1 ? 0 : column);
    if (tangent === null) return { configurations, end: "no progress" };
    const longest = Math.min(STEP_RAD, distanceToLimits(arm, q, tangent));
    if (longest < LEAST_STEP_RAD) return { configurations, end: "limit" };
    const next = takeStep(arm, q, tangent, longest, target);
    if (next === null) return { configurations, end: "no progress" };
    [q, previous] = [next, tangent];
    if (configurations.length > 1 && isNear(arm, q, start)) return { configurations, end: "closed loop" };
    configurations.push(q);
  }
  return { configurations, end: "length" };
}

/** Return the configuration after a step along a tangent, which is halved where the motion turns sharply; null for none. */
function takeStep(
  arm: ArmModel,
  q: Float64Array,
  tangent: Float64Array,
  longest: number,
  target: Float64Array,
): Float64Array | null {
  for (let step = longest; step > LEAST_STEP_RAD; step /= 2) {
    const predicted = addScaled(q, tangent, step);
    const { configuration, reached } = reachTarget(arm, predicted, target, arm.freeJoints([]), MAX_CORRECTORS);
    if (!reached || dotProduct(tangent, addScaled(configuration, q, -1)) < LEAST_PROGRESS * step) continue;
    const cosine = Math.abs(dotProduct(nullDirection(arm, configuration, 0), tangent));
    if (arm.redundancy > 1 || cosine > LEAST_COSINE) return configuration;
  }
  return null;
}

/** Return the unit direction (n) of the motion at q, which continues the previous one; null where it would turn back. */
function selfMotionDirection(
  arm: ArmModel,
  q: Float64Array,
  sign: number,
  previous: Float64Array | null,
  column: number | null,
): Float64Array | null {
  if (arm.redundancy === 0) return null;
  if (column !== null) {
    const tangent = previous === null ? nullDirection(arm, q, column) : projectOntoNullSpace(arm, q, previous);
    const norm = (previous === null ? sign : 1) * vectorNorm(tangent);
    return Math.abs(norm) < LEAST_COSINE ? null : tangent.map((value) => value / norm);
  }
  // Differences over a step average the gradients on both sides of a kink of the worst case.
  const slopes = Float64Array.from({ length: arm.redundancy }, (_, column) => {
    const offset = nullDirection(arm, q, column);
    return worstCase(arm, addScaled(q, offset, STEP_RAD / 2)) - worstCase(arm, addScaled(q, offset, -STEP_RAD / 2));
  });
  const gradient = Float64Array.from(arm.nullSpace(q), (row) => dotProduct(row, slopes));
  const norm = vectorNorm(gradient);
  if (norm < LEAST_SLOPE || (previous !== null && sign * dotProduct(gradient, previous) <= 0)) return null;
  return gradient.map((value) => (sign * value) / norm);
}

function projectOntoNullSpace(arm: ArmModel, q: Values, direction: Values): Float64Array {
  const rows = arm.nullSpace(q);
  const parts = Float64Array.from({ length: arm.redundancy }, (_, k) => rows.reduce((sum, row, j) => sum + row[k] * direction[j], 0));
  return Float64Array.from(rows, (row) => dotProduct(row, parts));
}

/** Return a unit vector (n) of the basis of the null space. */
function nullDirection(arm: ArmModel, q: Values, column: number): Float64Array {
  const direction = new Float64Array(arm.jointCount);
  arm.nullSpace(q).forEach((row, joint) => (direction[joint] = row[column]));
  return direction;
}

/** Return how far q can move along a direction until a joint is at its limit. */
function distanceToLimits(arm: ArmModel, q: Float64Array, direction: Float64Array): number {
  const distances = direction.map((rate, k) => (rate === 0 ? Infinity : ((rate > 0 ? arm.upper : arm.lower)[k] - q[k]) / rate));
  return Math.max(0, Math.min(...distances));
}

/** Return whether two configurations are nearly equal, apart from full turns of revolute joints. */
function isNear(arm: ArmModel, q: Float64Array, other: Float64Array): boolean {
  const differences = arm.joints.map((joint, k) => {
    const difference = q[k] - other[k];
    return joint.slides ? difference : difference - 2 * Math.PI * Math.round(difference / (2 * Math.PI));
  });
  return vectorNorm(differences) < RETURN_STEPS * STEP_RAD;
}
