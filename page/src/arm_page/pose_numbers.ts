/** Poses as the studio's state has them: x, y, z, m, and a unit quaternion x, y, z, w. */

import type { Pose } from "../viewer/scene";

export function poseFromNumbers([x, y, z, i, j, k, w]: number[]): Pose {
  const s = 2 / (i * i + j * j + k * k + w * w);
  return [
    ...[1 - s * (j * j + k * k), s * (i * j - k * w), s * (i * k + j * w), x],
    ...[s * (i * j + k * w), 1 - s * (i * i + k * k), s * (j * k - i * w), y],
    ...[s * (i * k - j * w), s * (j * k + i * w), 1 - s * (i * i + j * j), z],
  ];
}

export function numbersFromPose(a: Pose): number[] {
  // Rows of 4 q q' for the quaternion q; the longest row has no cancellation.
  const [x, y, z, w] = [a[9] - a[6], a[2] - a[8], a[4] - a[1], 1 + a[0] + a[5] + a[10]];
  const [xy, xz, yz] = [a[1] + a[4], a[2] + a[8], a[6] + a[9]];
  const rows = [
    [1 + a[0] - a[5] - a[10], xy, xz, x],
    [xy, 1 - a[0] + a[5] - a[10], yz, y],
    [xz, yz, 1 - a[0] - a[5] + a[10], z],
    [x, y, z, w],
  ];
  const longest = rows.reduce((best, row) => (Math.hypot(...row) > Math.hypot(...best) ? row : best));
  return [a[3], a[7], a[11], ...longest.map((value) => value / Math.hypot(...longest))];
}
