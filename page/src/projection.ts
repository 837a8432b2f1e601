/** Projections from the base frame and from the task's rows to the two axes of a view. */

import type { View } from "./experiment";

/** Project a point of the base frame, which begins at `offset` of an array. */
export function projectPoint(view: View, points: ArrayLike<number>, offset: number): [number, number] {
  const [right, up] = view.rows.map((row) => row.reduce((sum, factor, i) => sum + factor * points[offset + i], 0));
  return [right, up];
}

/** Project a vector of the task's rows: one or two rows are the view's own axes, three rows are the base frame's. */
export function projectTask(view: View, v: ArrayLike<number>): [number, number] {
  return v.length < 3 ? [v[0], v[1] ?? 0] : projectPoint(view, v, 0);
}
