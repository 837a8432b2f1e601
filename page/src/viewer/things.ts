/** Surroundings of an arm, as lines. */

import { across, column, cross, level, place, size, sum, unit } from "./algebra";
import type { Lost, Pose, Scene, Vector } from "./scene";

/** Segments of a line through points, which a closed one connects to the first. */
export function joined(points: Vector[], closed = false): Vector[] {
  return points.flatMap((p, k) => (k || closed ? [points.at(k - 1) as Vector, p] : []));
}

/** Corners of a regular polygon around a unit axis. */
export function circle(center: Vector, axis: Vector, radius: number, corners = 40): Vector[] {
  const first = across(axis);
  const second = cross(axis, first);
  return Array.from({ length: corners }, (_, k) => {
    const t = (2 * Math.PI * k) / corners;
    return sum(sum(center, first, radius * Math.cos(t)), second, radius * Math.sin(t));
  });
}

/** The edge of a cell of the floor, m: 1, 2 or 5 of a power of ten. */
export function cell(length: number): number {
  const rough = length / 8;
  const ten = 10 ** Math.floor(Math.log10(rough));
  return ten * ([5, 2].find((k) => k * ten <= rough) ?? 1);
}

/** Lines at right angles to the vertical, below the base. */
export function floor(scene: Scene): Vector[] {
  const step = cell(2 * scene.size);
  const count = Math.min(Math.ceil((1.1 * scene.size) / step), 12);
  const [first, second] = level(scene.up);
  const center = sum(place(scene.base), scene.up, -0.004 * scene.size);
  const out: Vector[] = [];
  for (let k = -count; k <= count; k++) {
    for (const [along, beside] of [[first, second], [second, first]]) {
      const middle = sum(center, beside, k * step);
      out.push(sum(middle, along, -count * step), sum(middle, along, count * step));
    }
  }
  return out;
}

export function triad(pose: Pose, length: number): Vector[][] {
  return [0, 1, 2].map((k) => [place(pose), sum(place(pose), column(pose, k), length)]);
}

export function edges({ low, high }: { low: Vector; high: Vector }): Vector[] {
  const corner = (k: number): Vector => [0, 1, 2].map((j) => (k & (1 << j) ? high : low)[j]) as Vector;
  const out: Vector[] = [];
  for (let k = 0; k < 8; k++) {
    for (const j of [1, 2, 4]) if (!(k & j)) out.push(corner(k), corner(k | j));
  }
  return out;
}

/** A lost direction: a line in both directions through the tool, and a ring about the axis of rotation. */
export function mark({ twist }: Lost, center: Vector, reach: number): { lines: Vector[]; end: Vector } {
  const linear = twist.slice(0, 3) as Vector;
  const angular = twist.slice(3) as Vector;
  const lines: Vector[] = [];
  let end = center;
  if (size(linear) > 0.05) {
    for (const sign of [-1, 1]) {
      end = sum(center, linear, sign * reach);
      const back = sum(end, linear, -0.16 * sign * reach);
      const beside = across(unit(linear));
      lines.push(center, end);
      for (const way of [beside, cross(unit(linear), beside)]) {
        for (const s of [-1, 1]) lines.push(end, sum(back, way, 0.07 * s * reach * size(linear)));
      }
    }
  }
  if (size(angular) > 0.05) {
    const ring = circle(center, unit(angular), 0.5 * reach * size(angular));
    lines.push(...joined(ring, true), sum(center, angular, -0.3 * reach), sum(center, angular, 0.3 * reach));
    if (end === center) end = ring[5];
  }
  return { lines, end };
}
