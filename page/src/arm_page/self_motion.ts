/** Self-motion of an arm: the configurations with the same pose of the tool. */

import type { ArmModel, Values } from "./arm_model";
import { relativeManipulability } from "./failures";
import { addScaled, columnNorms, combineRows, dotProduct, findComplement, vectorNorm, type Rows } from "./small_matrices";
import { REACHED_ERROR } from "./tool_drag";

const STEP_RAD = 0.03;
const LEAST_STEP_RAD = 1e-4;
const LEAST_SLOPE = 1e-9;
/** Relative manipulability of a joint up to which it does not take part in the self-motion. */
const NO_MOTION = 1e-9;
const MAX_STEPS = 1000;
const MAX_CORRECTORS = 8;
/** Error whose square is below that of a target that is reached: rad, and lengths in units of the arm's own length. */
const SMALL_ERROR = 1e-4;
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

/**
 * Trace the self-motion both ways from q while the locked joints stay: all of it where one direction is left, otherwise the
 * part along one of the directions, or without one along the gradient of the worst case, where it rises and where it falls.
 */
export function traceSelfMotion(
  arm: ArmModel,
  q: Values,
  locked: readonly number[] = [],
  column: number | null = null,
): SelfMotion {
  const tracer = new Tracer(arm, Float64Array.from(q), locked, column);
  const forward = tracer.traceOneWay(1);
  const backward = forward.end === "closed loop" ? { places: [], end: forward.end } : tracer.traceOneWay(-1);
  const places = [...backward.places.reverse(), tracer.start, ...forward.places];
  const worst = places.map((place) => place.worst);
  return {
    configurations: places.map((place) => place.q),
    worst,
    start: backward.places.length,
    best: worst.indexOf(Math.max(...worst)),
    ends: [backward.end, forward.end],
  };
}

interface Place {
  q: Float64Array;
  /** Smallest relative manipulability. */
  worst: number;
  /** Orthonormal joint velocities (each n) that move neither the tool nor a locked joint. */
  directions: Rows;
}

class Tracer {
  readonly start: Place;
  private readonly target: Float64Array;
  private readonly free: Float64Array;

  constructor(
    private readonly arm: ArmModel,
    q: Float64Array,
    private readonly locked: readonly number[],
    private column: number | null,
  ) {
    this.start = this.findPlace(q);
    this.target = arm.toolPose(q);
    this.free = arm.freeJoints(locked);
    if (this.start.directions.length === 1) this.column = 0;
  }

  traceOneWay(sign: number): { places: Place[]; end: MotionEnd } {
    const places: Place[] = [];
    let [place, previous]: [Place, Float64Array | null] = [this.start, null];
    while (places.length < MAX_STEPS) {
      const tangent = this.findTangent(place, sign, previous);
      if (tangent === null) return { places, end: "no progress" };
      const longest = Math.min(STEP_RAD, distanceToLimits(this.arm, place.q, tangent));
      if (longest < LEAST_STEP_RAD) return { places, end: "limit" };
      const bend = addScaled(tangent, previous ?? tangent, -1);
      const next = this.takeStep(place.q, tangent, bend, longest);
      if (next === null) return { places, end: "no progress" };
      [place, previous] = [next, tangent];
      if (places.length > 1 && isNear(this.arm, place.q, this.start.q)) return { places, end: "closed loop" };
      places.push(place);
    }
    return { places, end: "length" };
  }

  private findPlace(q: Float64Array): Place {
    const basis = this.arm.nullSpace(q);
    const norms = columnNorms(basis, q.length);
    const held = this.locked
      .filter((joint) => norms[joint] > NO_MOTION)
      .map((joint) => Float64Array.from(basis, (motion) => motion[joint]));
    const directions = held.length ? combineRows(findComplement(held, basis.length), basis) : basis;
    return { q, worst: Math.min(...norms), directions };
  }

  /** Return the place after a step along a tangent, which is halved where the motion turns sharply; null for none. */
  private takeStep(q: Float64Array, tangent: Float64Array, bend: Float64Array, longest: number): Place | null {
    for (let step = longest; step > LEAST_STEP_RAD; step /= 2) {
      const predicted = addScaled(addScaled(q, tangent, step), bend, (step * step) / (2 * STEP_RAD));
      const configuration = this.correct(this.arm.restrict(predicted));
      if (!configuration || dotProduct(tangent, addScaled(configuration, q, -1)) < LEAST_PROGRESS * step) continue;
      const next = this.findPlace(configuration);
      const [direction, ...others] = next.directions;
      if (others.length || (direction && Math.abs(dotProduct(direction, tangent)) > LEAST_COSINE)) return next;
    }
    return null;
  }

  /** Return a configuration near q with the target pose; away from limits, a corrector squares a small error. */
  private correct(q: Float64Array): Float64Array | null {
    for (let steps = 0; steps < MAX_CORRECTORS; steps++) {
      const { next, error } = this.arm.stepTowards(q, this.target, this.free);
      if (error < REACHED_ERROR) return q;
      const isInside = next.every((value, k) => value > this.arm.lower[k] && value < this.arm.upper[k]);
      if (error < SMALL_ERROR && isInside) return next;
      q = next;
    }
    return null;
  }

  /** Return the unit direction (n) of the motion, which continues the previous one; null where it would turn back. */
  private findTangent({ q, directions }: Place, sign: number, previous: Float64Array | null): Float64Array | null {
    if (!directions.length) return null;
    if (this.column !== null) {
      const tangent = previous === null ? directions[this.column] : project(previous, directions);
      const norm = (previous === null ? sign : 1) * vectorNorm(tangent);
      return Math.abs(norm) < LEAST_COSINE ? null : tangent.map((value) => value / norm);
    }
    // Differences over a step average the gradients on both sides of a kink of the worst case.
    const worst = (offset: Float64Array, length: number): number =>
      Math.min(...relativeManipulability(this.arm, addScaled(q, offset, length)));
    const slopes = directions.map((offset) => worst(offset, STEP_RAD / 2) - worst(offset, -STEP_RAD / 2));
    const gradient = combineRows([slopes], directions)[0];
    const norm = vectorNorm(gradient);
    if (norm < LEAST_SLOPE || (previous !== null && sign * dotProduct(gradient, previous) <= 0)) return null;
    return gradient.map((value) => (sign * value) / norm);
  }
}

/** Return the projection of a vector onto the span of orthonormal rows. */
const project = (vector: Float64Array, rows: Rows): Float64Array =>
  combineRows([rows.map((row) => dotProduct(row, vector))], rows)[0];

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
