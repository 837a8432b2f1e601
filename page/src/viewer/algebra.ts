/** Vectors, poses and the way from joint values to frames. */

import type { Chain, Joint, Pose, Vector } from "./scene";

export const sum = (a: Vector, b: Vector, scale = 1): Vector => [a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]];
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const size = (a: Vector): number => Math.sqrt(dot(a, a));
export const unit = (a: Vector): Vector => sum([0, 0, 0], a, 1 / (size(a) || 1));

/** A unit vector at right angles to another. */
export function across(a: Vector): Vector {
  const [x, y, z] = a.map(Math.abs);
  return unit(cross(a, x <= y && x <= z ? [1, 0, 0] : y <= z ? [0, 1, 0] : [0, 0, 1]));
}

/** Two directions at right angles to a unit vector; for z upward these are x and y. */
export function level(up: Vector): [Vector, Vector] {
  const first = Math.abs(up[0]) < 0.9 ? unit(sum([1, 0, 0], up, -up[0])) : across(up);
  return [first, cross(up, first)];
}

export function times(a: Pose, b: Pose): Pose {
  const out = [];
  for (let i = 0; i < 12; i += 4) {
    for (let k = 0; k < 4; k++) {
      out.push(a[i] * b[k] + a[i + 1] * b[4 + k] + a[i + 2] * b[8 + k] + (k === 3 ? a[i + 3] : 0));
    }
  }
  return out;
}

/** The pose that undoes a pose. */
export function inverse(a: Pose): Pose {
  return [0, 1, 2].flatMap((k) => [a[k], a[4 + k], a[8 + k], -dot(column(a, k), place(a))]);
}

export const place = (a: Pose): Vector => [a[3], a[7], a[11]];
export const column = (a: Pose, k: number): Vector => [a[k], a[4 + k], a[8 + k]];

/** A rotation about a unit axis by an angle, rad. */
export function rotation([x, y, z]: Vector, angle: number): Pose {
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  const v = 1 - c; // Rodrigues
  return [
    ...[c + v * x * x, v * x * y - s * z, v * x * z + s * y, 0],
    ...[v * x * y + s * z, c + v * y * y, v * y * z - s * x, 0],
    ...[v * x * z - s * y, v * y * z + s * x, c + v * z * z, 0],
  ];
}

function motion({ axis, slides }: Joint, value: number): Pose {
  const [x, y, z] = axis;
  return slides ? [1, 0, 0, x * value, 0, 1, 0, y * value, 0, 0, 1, z * value] : rotation(axis, value);
}

/** A point in the frame of a pose, m, in the world. */
export const transform = (pose: Pose, point: Vector): Vector =>
  [0, 4, 8].map((i) => pose[i] * point[0] + pose[i + 1] * point[1] + pose[i + 2] * point[2] + pose[i + 3]) as Vector;

/** Poses in the world of the base, of what moves with each joint and of the tool, as `Arm.frames` in Python. */
export function frames(chain: Chain, q: number[]): Pose[] {
  const out = [chain.base];
  chain.joints.forEach((joint, k) => out.push(times(times(out[k], joint.origin), motion(joint, q[k]))));
  return [...out, times(out[out.length - 1], chain.tool)];
}

/** Rows of a motion between two frames; `at` is a frame, with its fraction. */
export function between(rows: ArrayLike<number>[], at: number): number[] {
  const k = Math.min(Math.max(Math.floor(at), 0), rows.length - 1);
  const after = rows[Math.min(k + 1, rows.length - 1)];
  return Array.from(rows[k], (x, j) => x + (at - k) * (after[j] - x));
}
