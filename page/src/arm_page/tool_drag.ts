/** Configurations that put the tool on a target pose, for a drag and after it. */

import { Random } from "../random";
import type { ArmModel, Values } from "./arm_model";

const MAX_STEPS = 30;
const STARTS = 50;
/** Largest error of a target that is reached: rad, and lengths in units of the arm's own length. */
export const REACHED_ERROR = 1e-6;
/** Error from which on a further step only repeats rounding. */
const ROUNDING_ERROR = 1e-12;

export interface ReachedTarget {
  configuration: Float64Array;
  /** Norm of the error: rad, and lengths in units of the arm's own length. */
  error: number;
  reached: boolean;
}

/** Move the tool from q towards a pose (12 numbers) by damped steps of the free joints, and keep the nearest configuration. */
export function reachTarget(arm: ArmModel, q: Values, target: Values, free: Values, maxSteps = MAX_STEPS): ReachedTarget {
  let configuration: Float64Array = Float64Array.from(q);
  let [nearest, least] = [configuration, Infinity];
  for (let steps = 0; steps <= maxSteps && least > ROUNDING_ERROR; steps++) {
    const { next, error } = arm.stepTowards(configuration, target, free);
    if (error < least) [nearest, least] = [configuration, error];
    configuration = next;
  }
  return { configuration: nearest, error: least, reached: least <= REACHED_ERROR };
}

/** Search for a target from q and from 50 random starts within the limits; the locked joints stay at their values in q. */
export function searchTarget(arm: ArmModel, q: Values, target: Values, free: Values, seed = 1): ReachedTarget {
  const random = new Random(seed);
  let best = reachTarget(arm, q, target, free);
  for (let start = 0; start < STARTS && !best.reached; start++) {
    const found = reachTarget(arm, randomConfiguration(arm, q, free, random), target, free);
    if (found.error < best.error) best = found;
  }
  return best;
}

/** Sample the free joints within their limits; without a limit, within half a turn or 1 m of 0 or of the other limit. */
function randomConfiguration(arm: ArmModel, q: Values, free: Values, random: Random): Float64Array {
  return Float64Array.from(arm.joints, (joint, k) => {
    const range = joint.slides ? 1 : Math.PI;
    const lower = joint.low ?? Math.min(-range, (joint.high ?? 0) - range);
    const upper = joint.high ?? Math.max(range, (joint.low ?? 0) + range);
    return free[k] ? lower + (upper - lower) * random.uniform() : q[k];
  });
}
