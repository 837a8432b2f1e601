/** Configurations that put the tool on a target pose, for a drag and after it. */

import { Random } from "../random";
import type { ArmModel, Values } from "./arm_model";

const MAX_STEPS = 30;
const STARTS = 50;
/** Random starts in each picture of a drag, and the largest offset of their joints, rad and m. */
const NEAR_STARTS = 5;
const NEAR_RANGE = 0.3;
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

/**
 * Search for a target from q, and then from random starts within the limits and within a range around q, rad and m.
 *
 * The locked joints stay at their values in q. A target that no start reaches gets the nearest configuration found from q.
 */
export function searchTarget(
  arm: ArmModel,
  q: Values,
  target: Values,
  free: Values,
  starts = STARTS,
  range = Infinity,
): ReachedTarget {
  const random = new Random(1);
  const first = reachTarget(arm, q, target, free);
  let found = first;
  for (let start = 0; start < starts && !found.reached; start++) {
    found = reachTarget(arm, sampleConfiguration(arm, q, free, range, random), target, free);
  }
  return found.reached ? found : first;
}

/** Follow a dragged target; where joint limits stop the steps from q, starts near q can reach it. */
export const followTarget = (arm: ArmModel, q: Values, target: Values, free: Values): ReachedTarget =>
  searchTarget(arm, q, target, free, NEAR_STARTS, NEAR_RANGE);

/** Sample the free joints within their limits and a range; without a limit, within half a turn or 1 m of 0 or of the other limit. */
function sampleConfiguration(arm: ArmModel, q: Values, free: Values, range: number, random: Random): Float64Array {
  return Float64Array.from(arm.joints, (joint, k) => {
    const half = joint.slides ? 1 : Math.PI;
    const lower = Math.max(q[k] - range, joint.low ?? Math.min(-half, (joint.high ?? 0) - half));
    const upper = Math.min(q[k] + range, joint.high ?? Math.max(half, (joint.low ?? 0) + half));
    return free[k] ? lower + (upper - lower) * random.uniform() : q[k];
  });
}
