/** Draws each part as the convex hull of its projected corners on a canvas; needs no graphics card. */

import { sum, transform, unit } from "./algebra";
import { project } from "./camera";
import { css } from "./palette";
import type { Body, Picture } from "./renderer";
import type { Part, Vector } from "./scene";
import { vertices } from "./shapes";
import { circle } from "./things";

/** x, y, and possibly more, pixels. */
type Point = number[];

const RING_CORNERS = 20; // of each end of a tube, as in body.py
const MESH_DIRECTIONS = 320; // in which a mesh keeps its extreme vertex
const NEAREST_M = 0.01; // distance before the eye
const OBJECT_OPACITY = 0.35;
const OUTLINE_PX = 1.1;

/** Directions that are spread evenly over a sphere, on a spiral by the golden angle. */
export function spreadDirections(count: number): Vector[] {
  return Array.from({ length: count }, (_, k) => {
    const height = 1 - (2 * k + 1) / count;
    const angle = Math.PI * (3 - Math.sqrt(5)) * k;
    const radius = Math.sqrt(1 - height * height);
    return [radius * Math.cos(angle), radius * Math.sin(angle), height];
  });
}

/** Corners of a part in the frame of its link, m: both ends of a tube, or the extreme vertices of a mesh. */
export function corners({ mesh, tube }: Part): Vector[] {
  if (mesh) {
    const all = vertices(mesh);
    const extremes = spreadDirections(MESH_DIRECTIONS).map(([x, y, z]) => {
      let [best, highest] = [0, -Infinity];
      for (let k = 0; k < all.length; k += 3) {
        const height = x * all[k] + y * all[k + 1] + z * all[k + 2];
        if (height > highest) [best, highest] = [k, height];
      }
      return best;
    });
    return [...new Set(extremes)].map((k) => [all[k], all[k + 1], all[k + 2]]);
  }
  const [a, b, c, d, e, f, radius] = tube as number[];
  const axis = unit([d - a, e - b, f - c]);
  return [[a, b, c], [d, e, f]].flatMap((center) => circle(center as Vector, axis, radius, RING_CORNERS));
}

/** Twice the area of the triangle a, b, c, above 0 if it runs from x to y. */
const area = (a: Point, b: Point, c: Point): number => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

/** Corners of the convex hull of points, in order (Andrew 1979). */
export function hull(points: Point[]): Point[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (ordered: Point[]): Point[] => {
    const chain: Point[] = [];
    for (const point of ordered) {
      while (chain.length > 1 && area(chain[chain.length - 2], chain[chain.length - 1], point) <= 0) chain.pop();
      chain.push(point);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

type PlacedPart = Pick<Body, "part" | "pose">;

/** The body under a point of the picture, pixels, whose surface is nearest to the eye; null for none. */
export function findBody(bodies: PlacedPart[], locate: (point: Vector) => Vector, point: Point): PlacedPart | null {
  let [found, nearest]: [PlacedPart | null, number] = [null, Infinity];
  for (const body of bodies) {
    const points = corners(body.part).map((corner) => locate(transform(body.pose, corner)));
    const depth = Math.min(...points.map((corner) => corner[2]));
    const outline = hull(points);
    const inside = outline.every((corner, k) => area(corner, outline[(k + 1) % outline.length], point) >= 0);
    if (inside && depth > NEAREST_M && depth < nearest) [found, nearest] = [body, depth];
  }
  return found;
}

/** The piece of a segment before the eye, if any. */
function clip(matrix: Float32Array, start: Vector, end: Vector): Vector[] {
  const [a, b] = [start, end].map((point) => project(matrix, point, 1, 1)[2] - NEAREST_M);
  if (a < 0 && b < 0) return [];
  const cut = sum(start, sum(end, start, -1), a / (a - b));
  return [a < 0 ? cut : start, b < 0 ? cut : end];
}

const cornersByPart = new WeakMap<Part, Vector[]>();
let layer: CanvasRenderingContext2D | null = null;

/** An empty canvas, the same one for all pictures. */
function clearLayer(width: number, height: number): CanvasRenderingContext2D {
  layer ??= document.createElement("canvas").getContext("2d") as CanvasRenderingContext2D;
  if (layer.canvas.width !== width || layer.canvas.height !== height) Object.assign(layer.canvas, { width, height });
  layer.clearRect(0, 0, width, height);
  return layer;
}

export class HullRenderer {
  /** Whether near solids hide those behind them in any order; otherwise a solid covers those before it. */
  readonly hidesFarther: boolean = false;

  constructor(protected readonly picture: Picture) {
    picture.onto.lineJoin = picture.onto.lineCap = "round";
  }

  /** Corners of a body in pixels, and their mean distance before the eye, m; none if it extends behind the eye. */
  private place({ part, pose }: Body): { points: Point[]; depth: number } | null {
    const { matrix: m, onto } = this.picture;
    let local = cornersByPart.get(part);
    if (!local) cornersByPart.set(part, (local = corners(part)));
    const row = (i: number): number[] =>
      [0, 1, 2, 3].map((k) => m[i] * pose[k] + m[4 + i] * pose[4 + k] + m[8 + i] * pose[8 + k] + (k === 3 ? m[12 + i] : 0));
    const [x, y, w] = [row(0), row(1), row(3)];
    const [right, down] = [onto.canvas.width / 2, onto.canvas.height / 2];
    let depth = 0;
    const points: Point[] = [];
    for (const [a, b, c] of local) {
      const distance = w[0] * a + w[1] * b + w[2] * c + w[3];
      if (distance < NEAREST_M) return null;
      depth += distance / local.length;
      points.push([
        right * (1 + (x[0] * a + x[1] * b + x[2] * c + x[3]) / distance),
        down * (1 - (y[0] * a + y[1] * b + y[2] * c + y[3]) / distance),
      ]);
    }
    return { points, depth };
  }

  /** Draw bodies; those that are over all others are the last ones. */
  solids(bodies: Body[], opacity = 1, _over = false): void {
    const { onto, palette, ratio } = this.picture;
    const { width, height } = onto.canvas;
    const drawn = bodies.flatMap((body) => {
      const placed = this.place(body);
      return placed ? [{ ...body, ...placed, isObject: body.part.object === true }] : [];
    });
    // Of parts at the same depth, to a millimetre, later ones cover earlier ones, as in the still drawing.
    drawn.sort((a, b) => Number(b.isObject) - Number(a.isObject) || Math.round(1000 * b.depth) - Math.round(1000 * a.depth));
    // Parts of a transparent arm do not show through each other, because it is drawn on a layer.
    const target = opacity < 1 && drawn.length > 1 ? clearLayer(width, height) : onto;
    target.lineJoin = "round";
    target.lineWidth = OUTLINE_PX * ratio;
    target.strokeStyle = css(palette.outline);
    const trace = (points: Point[], color: Vector): void => {
      target.beginPath();
      for (const [x, y] of points) target.lineTo(x, y);
      target.closePath();
      target.fillStyle = css(color);
      target.fill();
      target.stroke();
    };
    for (const { part, points, color, isObject } of drawn) {
      target.globalAlpha = (isObject ? OBJECT_OPACITY : 1) * (target === onto ? opacity : 1);
      trace(hull(points), color);
      if (!part.tube) continue;
      // The end of a tube that is seen from outside runs round the other way.
      for (const ring of [points.slice(0, RING_CORNERS).reverse(), points.slice(RING_CORNERS)]) {
        if (area(ring[0], ring[1], ring[2]) < 0) trace(ring, color.map((x) => 0.8 * x + 0.2) as Vector);
      }
    }
    if (target !== onto) {
      onto.globalAlpha = opacity;
      onto.drawImage(target.canvas, 0, 0);
    }
    onto.globalAlpha = 1;
  }

  /** Draw segments between pairs of points; `width` in CSS pixels. */
  lines(points: Vector[], color: Vector, width: number, opacity = 1): void {
    const { matrix, onto, ratio } = this.picture;
    onto.beginPath();
    for (let k = 0; k + 1 < points.length; k += 2) {
      const ends = clip(matrix, points[k], points[k + 1]);
      const [start, end] = ends.map((point) => project(matrix, point, onto.canvas.width, onto.canvas.height));
      if (!start) continue;
      onto.moveTo(start[0], start[1]);
      onto.lineTo(end[0], end[1]);
    }
    onto.strokeStyle = css(color, opacity);
    onto.lineWidth = width * ratio;
    onto.stroke();
  }

  /** Draw discs; `width` in CSS pixels. */
  dots(points: Vector[], colors: Vector[], width: number): void {
    const { matrix, onto, ratio } = this.picture;
    points.forEach((point, k) => {
      const [x, y, depth] = project(matrix, point, onto.canvas.width, onto.canvas.height);
      if (depth < NEAREST_M) return;
      onto.beginPath();
      onto.arc(x, y, (width * ratio) / 2, 0, 2 * Math.PI);
      onto.fillStyle = css(colors[k]);
      onto.fill();
    });
  }
}
