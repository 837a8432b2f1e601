/** What locked joints take from an arm: relative manipulability, lost motions, and the ellipsoid of the tool. */

import type { Vector } from "../viewer/scene";
import type { ArmModel, Values } from "./arm_model";
import {
  addScaled, columnNorms, combineRows, dotProduct, factorRows, findSingularValues, solveTransposed, vectorNorm, type Rows,
} from "./small_matrices";

/** Norm up to which the projection of locked joints onto the motions of the task is rounding. */
const NO_PROJECTION = 1e-9;

/** Return the relative manipulability (n) that remains if each joint locks, from 0 to 1. */
export const relativeManipulability = (arm: ArmModel, q: Values): Float64Array => columnNorms(arm.nullSpace(q), arm.jointCount);

/** Return the joint, from 0, with the smallest value. */
export const worstJoint = (manipulability: Float64Array): number => manipulability.indexOf(Math.min(...manipulability));

/** A motion of the tool that locked joints impair. */
export interface LostMotion {
  /** Fraction that remains of the largest speed along the twist at joint velocities of norm 1, from 0 to 1. */
  remaining: number;
  /** Twist in the world (6) of norm 1, m/s and rad/s; 0 if all of its speed remains. */
  twist: Float64Array;
}

/**
 * Return the motions that locked joints impair, worst first; the others keep their speed.
 *
 * With the locked rows `N_F = U S V'` of a null-space basis, the fraction s of the motion `(J J')^-1 J_F u` remains.
 */
export function lostMotions(arm: ArmModel, q: Values, locked: readonly number[]): LostMotion[] {
  const { basis, lower } = factorRows(taskJacobian(arm, q));
  const selfMotions = arm.nullSpace(q);
  const lockedRows = locked.map((joint) => selfMotions.map((motion) => motion[joint]));
  const fractions = findSingularValues(lockedRows).slice(-arm.taskRows.length);
  return fractions.reverse().map(({ value, direction }) => {
    const projection = Float64Array.from(basis, (row) => dotProduct(locked.map((joint) => row[joint]), direction));
    const motion = solveTransposed(lower, projection);
    const norm = vectorNorm(projection) > NO_PROJECTION ? vectorNorm(motion) : Infinity;
    const twist = Float64Array.from({ length: 6 }, (_, k) => dotProduct(arm.taskRows.map((row) => row[k]), motion) / norm);
    return { remaining: value, twist };
  });
}

/** Ellipsoid of the velocities of the tool point in the world at joint velocities of norm 1. */
export interface Ellipsoid {
  /** Half axes, m/s, largest first, and their directions. */
  halfAxes: Vector;
  directions: [Vector, Vector, Vector];
}

/** Return the ellipsoid of a tool that does not rotate about the axes that the task prescribes; locked joints do not move. */
export function toolEllipsoid(arm: ArmModel, q: Values, locked: readonly number[]): Ellipsoid {
  const jacobian = arm.jacobian(q);
  for (const row of jacobian) for (const joint of locked) row[joint] = 0;
  const rotations = combineRows(arm.taskRows.map((row) => row.slice(3)), jacobian.slice(3));
  const { basis } = factorRows(rotations);
  const velocities = jacobian.slice(0, 3).map((row) => basis.reduce(removePart, row));
  const axes = findSingularValues(velocities);
  return {
    halfAxes: axes.map((axis) => axis.value) as Vector,
    directions: axes.map((axis) => Array.from(axis.direction)) as Ellipsoid["directions"],
  };
}

const removePart = (row: Float64Array, unit: Float64Array): Float64Array => addScaled(row, unit, -dotProduct(unit, row));

const taskJacobian = (arm: ArmModel, q: Values): Rows => combineRows(arm.taskRows, arm.jacobian(q));
