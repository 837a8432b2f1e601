/** Draws each part as the convex hull of its projected corners on a canvas; needs no graphics card. */

import { across, cross, sum, unit } from "./algebra";
import { project } from "./camera";
import { css } from "./palette";
import type { Body, Lines, Picture, Renderer } from "./renderer";
import type { Part, Vector } from "./scene";
import { vertices } from "./shapes";

/** x, y, and possibly more, pixels. */
type Point = number[];

const RING_CORNERS = 24; // of each flat end of a tube
const BALL_CORNERS = 96; // of each round end of a tube
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

/** Corners of a part in the frame of its link, m: of a mesh, the extreme vertices along each direction. */
export function corners({ mesh, tube, round }: Part): Vector[] {
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
  const ends: Vector[] = [[a, b, c], [d, e, f]];
  if (round) return ends.flatMap((end) => spreadDirections(BALL_CORNERS).map((direction) => sum(end, direction, radius)));
  const axis = unit(sum(ends[1], ends[0], -1));
  const first = across(axis);
  const second = cross(axis, first);
  return ends.flatMap((end) =>
    Array.from({ length: RING_CORNERS }, (_, k) => {
      const angle = (2 * Math.PI * k) / RING_CORNERS;
      return sum(sum(end, first, radius * Math.cos(angle)), second, radius * Math.sin(angle));
    }),
  );
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

/** The piece of a segment before the eye, if any. */
function clip(matrix: Float32Array, start: Vector, end: Vector): [Vector, Vector] | null {
  const [a, b] = [start, end].map((point) => project(matrix, point, 1, 1)[2] - NEAREST_M);
  if (a < 0 && b < 0) return null;
  const cut = sum(start, sum(end, start, -1), a / (a - b));
  return [a < 0 ? cut : start, b < 0 ? cut : end];
}

interface Outline {
  hull: Point[];
  /** The visible flat end of a tube. */
  cap: Point[] | null;
  /** Mean distance before the eye. */
  depth: number;
}

export class HullRenderer implements Renderer {
  readonly hidesFarther = false;
  private readonly known = new WeakMap<Part, Vector[]>();
  private readonly layer = document.createElement("canvas");
  private picture: Picture | null = null;
  private context: CanvasRenderingContext2D | null = null;

  begin(picture: Picture): void {
    this.picture = picture;
    this.context = picture.onto;
    picture.onto.lineJoin = picture.onto.lineCap = "round";
  }

  finish(): void {
    this.picture = this.context = null;
  }

  over(): void {}

  /** Outline of a body on the picture, in its pixels; none if it extends behind the eye. */
  outline({ part, pose }: Body, { matrix: m, onto }: Picture): Outline | null {
    let local = this.known.get(part);
    if (!local) this.known.set(part, (local = corners(part)));
    const row = (i: number): number[] =>
      [0, 1, 2, 3].map((k) => m[i] * pose[k] + m[4 + i] * pose[4 + k] + m[8 + i] * pose[8 + k] + (k === 3 ? m[12 + i] : 0));
    const [x, y, w] = [row(0), row(1), row(3)];
    const [right, down] = [onto.canvas.width / 2, onto.canvas.height / 2];
    let depth = 0;
    const points: Point[] = [];
    for (const [a, b, c] of local) {
      const distance = w[0] * a + w[1] * b + w[2] * c + w[3];
      if (distance <= 0) return null;
      depth += distance / local.length;
      points.push([
        right * (1 + (x[0] * a + x[1] * b + x[2] * c + x[3]) / distance),
        down * (1 - (y[0] * a + y[1] * b + y[2] * c + y[3]) / distance),
      ]);
    }
    const rings = part.tube && !part.round ? [points.slice(0, RING_CORNERS).reverse(), points.slice(RING_CORNERS)] : [];
    return { hull: hull(points), cap: rings.find(([a, b, c]) => area(a, b, c) < 0) ?? null, depth };
  }

  solids(bodies: Body[], opacity = 1): void {
    const { picture, context } = this;
    if (!picture || !context) return;
    const seen = bodies.flatMap((body) => {
      const outline = this.outline(body, picture);
      return outline ? [{ ...outline, color: body.color, back: body.part.object === true }] : [];
    });
    // Of parts at the same depth, to a millimetre, later ones cover earlier ones, as in the still drawing.
    seen.sort((a, b) => Number(b.back) - Number(a.back) || Math.round(1000 * b.depth) - Math.round(1000 * a.depth));
    // Parts of a transparent arm do not show through each other.
    const target = opacity < 1 && seen.length > 1 ? this.clearLayer(context.canvas) : context;
    if (!target) return;
    target.lineWidth = OUTLINE_PX * (context.canvas.width / context.canvas.clientWidth || 1);
    target.strokeStyle = css(picture.palette.outline);
    target.lineJoin = "round";
    const trace = (points: Point[], color: Vector): void => {
      target.beginPath();
      for (const [x, y] of points) target.lineTo(x, y);
      target.closePath();
      target.fillStyle = css(color);
      target.fill();
      target.stroke();
    };
    for (const { hull, cap, color, back } of seen) {
      target.globalAlpha = (back ? OBJECT_OPACITY : 1) * (target === context ? opacity : 1);
      trace(hull, color);
      if (cap) trace(cap, color.map((x) => 0.8 * x + 0.2) as Vector);
    }
    target.globalAlpha = 1;
    if (target === context) return;
    context.globalAlpha = opacity;
    context.drawImage(target.canvas, 0, 0);
    context.globalAlpha = 1;
  }

  private clearLayer({ width, height }: HTMLCanvasElement): CanvasRenderingContext2D | null {
    const { layer } = this;
    if (layer.width !== width || layer.height !== height) [layer.width, layer.height] = [width, height];
    const context = layer.getContext("2d");
    context?.clearRect(0, 0, width, height);
    return context;
  }

  lines({ points, color, width, opacity = 1 }: Lines): void {
    const { picture, context } = this;
    if (!picture || !context) return;
    const { canvas } = context;
    context.beginPath();
    for (let k = 0; k + 1 < points.length; k += 2) {
      const segment = clip(picture.matrix, points[k], points[k + 1]);
      segment?.forEach((point, j) => {
        const [x, y] = project(picture.matrix, point, canvas.width, canvas.height);
        if (j) context.lineTo(x, y);
        else context.moveTo(x, y);
      });
    }
    context.strokeStyle = css(color, opacity);
    context.lineWidth = width;
    context.stroke();
  }

  dots(points: Vector[], colors: Vector[], width: number): void {
    const { picture, context } = this;
    if (!picture || !context) return;
    points.forEach((point, k) => {
      const [x, y, depth] = project(picture.matrix, point, context.canvas.width, context.canvas.height);
      if (depth <= 0) return;
      context.beginPath();
      context.arc(x, y, width / 2, 0, 2 * Math.PI);
      context.fillStyle = css(colors[k]);
      context.fill();
    });
  }
}
