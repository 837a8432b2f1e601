/** Projections from the base frame and from the task's rows to the two axes of a view. */

import type { View } from "../experiment";

/** A point of the base frame, at `offset` of an array. */
export function point(view: View, points: ArrayLike<number>, offset: number): [number, number] {
  const along = (row: number[]): number =>
    row[0] * points[offset] + row[1] * points[offset + 1] + row[2] * points[offset + 2];
  return [along(view.rows[0]), along(view.rows[1])];
}

/** A vector of the task's rows: of one or two rows the view's own axes, of three the base frame's. */
export function task(view: View, v: ArrayLike<number>): [number, number] {
  return v.length < 3 ? [v[0], v[1] ?? 0] : point(view, v, 0);
}
