/** Motion of an arm to a target under a control law that does not know which joints are locked. */

import type { Vector } from "../viewer/scene";
import type { ArmModel, Values } from "./arm_model";
import type { Story } from "./data";
import { addScaled, combineRows, dotProduct, vectorNorm } from "./small_matrices";

const CONTROL_STEP_S = 0.02;
const DURATION_S = 12;
/** Largest estimated error of a step, rad and m; a step with a larger error is halved. */
const STEP_ERROR = 1e-10;
const SHORTEST_STEP_S = 1e-5;
/** Largest number of halved steps in a motion, which a law that switches back and forth reaches. */
const MAX_HALVINGS = 1000;
/** Method of order 5 (Dormand and Prince 1980): weights of the rates before each stage, and of the error estimate. */
const STAGES = [
  [1 / 5],
  [3 / 40, 9 / 40],
  [44 / 45, -56 / 15, 32 / 9],
  [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729],
  [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656],
  [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
];
const ERRORS = [71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40];
/** Distance from the target at which the motion ends, m. */
const END_M = 0.001;

export interface ControlledMotion {
  /** Times of the configurations, s. */
  time: number[];
  q: Float64Array[];
  /** Largest distance of the tool from the straight line to the target, m. */
  deviation: number;
}

/** Simulate 12 s of a motion under a law of `PrintedKernels.laws` to a target, m, or less if it arrives or has no answer. */
export function simulateControl(
  arm: ArmModel,
  q: Values,
  target: Vector,
  locked: readonly number[],
  settings: { law: string } & Pick<Story, "gain" | "speed">,
): ControlledMotion {
  const free = arm.freeJoints(locked);
  const errorAt = (state: Float64Array): Float64Array => addScaled(target, arm.toolPosition(state), -1);
  const rates = (state: Float64Array): Float64Array => {
    const error = errorAt(state);
    const gain = Math.min(settings.gain, settings.speed / vectorNorm(error));
    return arm.commandRates(settings.law, state, error.map((value) => gain * value)).map((rate, k) => free[k] * rate);
  };
  let [halvings, slope] = [0, rates(Float64Array.from(q))];
  /** Return the state after a duration and keep its rates; steps are halved because damping and speed have kinks. */
  const advance = (start: Float64Array, duration: number): Float64Array => {
    const [slopes, combine] = [[slope], (weights: number[]) => combineRows([weights], slopes)[0]];
    let end = start;
    for (const weights of STAGES) {
      end = addScaled(start, combine(weights), duration);
      slopes.push(rates(end));
    }
    const error = duration * vectorNorm(combine(ERRORS));
    if (error > STEP_ERROR && duration > SHORTEST_STEP_S && halvings < MAX_HALVINGS) {
      halvings++;
      return advance(advance(start, duration / 2), duration / 2);
    }
    slope = slopes[STAGES.length];
    return end;
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
    state = advance(state, CONTROL_STEP_S);
  }
  return motion;
}

/** Return the distance of a point from the straight line to a target, m; `error` and `line` end at the target. */
function distanceFromLine(error: Float64Array, line: Float64Array): number {
  const fraction = Math.min(1, Math.max(0, dotProduct(error, line) / dotProduct(line, line)));
  return vectorNorm(addScaled(error, line, -fraction));
}
