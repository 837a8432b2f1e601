/** Falls of an arm whose joints have lost their torque: all of them until the brakes close, or one until it is at rest. */

import type { Vector } from "../viewer/scene";
import type { ArmModel, Values } from "./arm_model";
import { addScaled, dotProduct, splitRows, stepRungeKutta, vectorNorm } from "./small_matrices";

const STEP_S = 0.002;
/** Largest product of a step and a damping rate; the method of order 4 is stable up to 2.78. */
const STABLE_RATE = 2;
/** Acceleration of a joint below which it does not swing, rad/s^2 or m/s^2. */
const REST_ACCELERATION = 1e-9;

export interface Fall {
  /** Times of the configurations and of the displacements of the tool along gravity, s and m. */
  time: number[];
  configurations: Float64Array[];
  drop: number[];
  /** Joint, from 0, whose limit ends the fall; null if the brakes end it. */
  limitJoint: number | null;
}

/** Simulate the fall of the free joints (n, each 0 or 1) from rest until the brakes close, s, or a joint is at its limit. */
export function simulateFall(arm: ArmModel, q: Values, free: Values, brakeTime: number, gravity: Vector): Fall {
  const down = gravity.map((value) => value / vectorNorm(gravity));
  const start = arm.toolPosition(q);
  const derivative = (state: Float64Array): Float64Array => {
    const [configuration, rates] = splitRows(state, 2);
    return Float64Array.from([...rates, ...arm.accelerations(configuration, rates, free)]);
  };
  const substeps = Math.max(1, Math.ceil((STEP_S * dampingRate(arm, q, free)) / STABLE_RATE));
  const advance = (state: Float64Array, duration: number): Float64Array => {
    for (let k = 0; k < substeps; k++) state = stepRungeKutta(derivative, state, duration / substeps);
    return state;
  };
  const fall: Fall = { time: [0], configurations: [Float64Array.from(q)], drop: [0], limitJoint: null };
  let time = 0;
  let state: Float64Array = new Float64Array(2 * arm.jointCount);
  state.set(q);
  while (time < brakeTime - 1e-9 && fall.limitJoint === null) {
    const before = splitRows(state, 2)[0];
    let step = Math.min(STEP_S, brakeTime - time);
    let next = advance(state, step);
    const crossing = firstCrossing(arm, before, splitRows(next, 2)[0], free);
    if (crossing !== null) {
      fall.limitJoint = crossing[0];
      step *= crossing[1];
      next = advance(state, step);
    }
    [time, state] = [time + step, next];
    const configuration = arm.restrict(splitRows(state, 2)[0]);
    fall.time.push(time);
    fall.configurations.push(configuration);
    fall.drop.push(dotProduct(addScaled(arm.toolPosition(configuration), start, -1), down));
  }
  return fall;
}

/** Return a bound of the rate, 1/s, at which viscous friction slows the free joints down: the trace of its matrix. */
function dampingRate(arm: ArmModel, q: Values, free: Values): number {
  const accelerate = (moving: number, k: number): number =>
    arm.accelerations(q, arm.joints.map((_, joint) => (joint === moving ? 1 : 0)), free)[k];
  return arm.joints.reduce((total, _, k) => total + accelerate(-1, k) - accelerate(k, k), 0);
}

/** Return the free joint that first crosses a limit between two configurations, and the fraction of the step; null for none. */
function firstCrossing(arm: ArmModel, before: Float64Array, after: Float64Array, free: Values): [number, number] | null {
  let first: [number, number] | null = null;
  for (let k = 0; k < after.length; k++) {
    if (!free[k] || (after[k] >= arm.lower[k] && after[k] <= arm.upper[k])) continue;
    const limit = after[k] < arm.lower[k] ? arm.lower[k] : arm.upper[k];
    const fraction = Math.max(0, (limit - before[k]) / (after[k] - before[k]));
    if (first === null || fraction < first[1]) first = [k, fraction];
  }
  return first;
}

/** Swing of one joint that has lost its torque while the others are held. */
export interface Swing {
  /** Angle to the lowest position of the parts beyond the joint, rad, or displacement to the limit, m; within the limits. */
  toRest: number;
  /** Largest angle without friction, rad, or displacement, m; within the limits. */
  toFarthest: number;
}

/** Return the swing of a joint from rest. */
export function swingJoint(arm: ArmModel, q: Values, joint: number): Swing {
  const free = arm.freeJoints([]).map((_, k) => (k === joint ? 1 : 0));
  const accelerate = (offset: number): number =>
    arm.accelerations(addScaled(q, free, offset), free.map(() => 0), free)[joint];
  const acceleration = accelerate(0);
  const stop = (offset: number): number => arm.restrict(addScaled(q, free, offset))[joint] - q[joint];
  if (arm.joints[joint].slides) {
    const toRest = Math.abs(acceleration) < REST_ACCELERATION ? 0 : stop(Math.sign(acceleration) * Infinity);
    return { toRest, toFarthest: toRest };
  }
  // The torque of gravity is a sine of the angle, so its values at two angles determine it.
  const quarterTurn = accelerate(Math.PI / 2);
  if (Math.hypot(acceleration, quarterTurn) < REST_ACCELERATION) return { toRest: 0, toFarthest: 0 };
  const angle = Math.atan2(acceleration, -quarterTurn);
  return { toRest: stop(angle), toFarthest: stop(2 * angle) };
}
