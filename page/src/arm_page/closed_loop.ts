/** Motion of an arm to a target under a control law that does not know which joints are locked. */

import type { Vector } from "../viewer/scene";
import type { ArmModel, Values } from "./arm_model";
import { addScaled, dotProduct, stepRungeKutta, vectorNorm } from "./small_matrices";

const CONTROL_STEP_S = 0.02;
const DURATION_S = 12;
/** Largest difference between a step and its halves, rad and m, and a step that is not halved again. */
const STEP_ERROR = 1e-7;
const SHORTEST_STEP_S = 2e-4;
/** Distance from the target at which the motion ends, m. */
const END_M = 0.001;

export interface ControlSettings {
  /** Key in `PrintedKernels.laws`. */
  law: string;
  /** Proportional gain, 1/s. */
  gain: number;
  /** Maximum commanded speed of the tool, m/s. */
  speed: number;
}

export interface ControlledMotion {
  /** Times of the configurations, s. */
  time: number[];
  q: Float64Array[];
  /** Largest distance of the tool from the straight line to the target, m. */
  deviation: number;
}

/** Simulate 12 s of a motion from q to a target, m, or less if the tool arrives or the law has no answer. */
export function simulateControl(
  arm: ArmModel,
  q: Values,
  target: Vector,
  locked: readonly number[],
  settings: ControlSettings,
): ControlledMotion {
  const free = arm.freeJoints(locked);
  const errorAt = (state: Float64Array): Float64Array => addScaled(target, arm.toolPosition(state), -1);
  const rates = (state: Float64Array): Float64Array => {
    const error = errorAt(state);
    const gain = Math.min(settings.gain, settings.speed / vectorNorm(error));
    return arm.commandRates(settings.law, state, error.map((value) => gain * value)).map((rate, k) => free[k] * rate);
  };
  const motion: ControlledMotion = { time: [], q: [], deviation: 0 };
  let state: Float64Array = Float64Array.from(q);
  const line = errorAt(state);
  for (let step = 0; step <= DURATION_S / CONTROL_STEP_S && state.every(Number.isFinite); step++) {
    const error = errorAt(state);
    motion.time.push(step * CONTROL_STEP_S);
    motion.q.push(state);
    motion.deviation = Math.max(motion.deviation, distanceFromLine(error, line));
    if (vectorNorm(error) <= END_M) break;
    state = advance(rates, state, CONTROL_STEP_S);
  }
  return motion;
}

/** Return the state after a duration; a step is halved until its halves agree with it, because damping and speed have kinks. */
function advance(derivative: (state: Float64Array) => Float64Array, state: Float64Array, duration: number): Float64Array {
  const whole = stepRungeKutta(derivative, state, duration);
  const middle = stepRungeKutta(derivative, state, duration / 2);
  const halves = stepRungeKutta(derivative, middle, duration / 2);
  const error = vectorNorm(addScaled(halves, whole, -1));
  if (error <= STEP_ERROR || duration < SHORTEST_STEP_S) return halves;
  return advance(derivative, advance(derivative, state, duration / 2), duration / 2);
}

/** Return the distance of a point from the straight line to a target, m; `error` and `line` end at the target. */
function distanceFromLine(error: Float64Array, line: Float64Array): number {
  const fraction = Math.min(1, Math.max(0, dotProduct(error, line) / dotProduct(line, line)));
  return vectorNorm(addScaled(error, line, -fraction));
}
