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
/** A step that moves the arm by less than this fraction of its length ends the motion. */
const LEAST_PROGRESS = 0.4;
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
 * Trace the self-motion both ways from q: all of it for an arm with one redundant joint, otherwise the part along the
 * projected gradient of the worst case, where it rises and where it falls.
 */
export function traceSelfMotion(arm: ArmModel, q: Values): SelfMotion {
  const start = Float64Array.from(q);
  const target = arm.toolPose(start);
  const forward = traceOneWay(arm, start, target, 1);
  const isLoop = forward.end === "closed loop";
  const backward: OneWay = isLoop ? { configurations: [], end: "closed loop" } : traceOneWay(arm, start, target, -1);
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

function traceOneWay(arm: ArmModel, start: Float64Array, target: Float64Array, sign: number): OneWay {
  const configurations: Float64Array[] = [];
  const free = arm.freeJoints([]);
  let [q, previous]: [Float64Array, Float64Array | null] = [start, null];
  while (configurations.length < MAX_STEPS) {
    const tangent = selfMotionDirection(arm, q, sign, previous);
    if (tangent === null) return { configurations, end: "no progress" };
    const step = Math.min(STEP_RAD, distanceToLimits(arm, q, tangent));
    if (step < LEAST_STEP_RAD) return { configurations, end: "limit" };
    const corrected = reachTarget(arm, addScaled(q, tangent, step), target, free, MAX_CORRECTORS);
    const progress = dotProduct(tangent, addScaled(corrected.configuration, q, -1));
    if (!corrected.reached || progress < LEAST_PROGRESS * step) return { configurations, end: "no progress" };
    [q, previous] = [corrected.configuration, tangent];
    if (configurations.length > 1 && isNear(arm, q, start)) return { configurations, end: "closed loop" };
    configurations.push(q);
  }
  return { configurations, end: "length" };
}

/** Return the unit direction (n) of the motion at q, which continues the previous one; null where it would turn back. */
function selfMotionDirection(arm: ArmModel, q: Float64Array, sign: number, previous: Float64Array | null): Float64Array | null {
  const nullSpace = arm.nullSpace(q);
  const redundancy = nullSpace[0].length;
  if (redundancy === 0) return null;
  if (redundancy === 1) {
    const tangent = Float64Array.from(nullSpace, (row) => row[0]);
    const orientation = previous === null ? sign : Math.sign(dotProduct(tangent, previous));
    return tangent.map((value) => orientation * value);
  }
  // Differences over a step average the gradients on both sides of a kink of the worst case.
  const slopes = Float64Array.from({ length: redundancy }, (_, column) => {
    const offset = Float64Array.from(nullSpace, (row) => row[column]);
    return worstCase(arm, addScaled(q, offset, STEP_RAD / 2)) - worstCase(arm, addScaled(q, offset, -STEP_RAD / 2));
  });
  const gradient = Float64Array.from(nullSpace, (row) => dotProduct(row, slopes));
  const norm = vectorNorm(gradient);
  if (norm < LEAST_SLOPE || (previous !== null && sign * dotProduct(gradient, previous) <= 0)) return null;
  return gradient.map((value) => (sign * value) / norm);
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
