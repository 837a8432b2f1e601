/** SVG over the picture of an arm: ellipsoids, lost directions, trails, locks, and labels; CSS classes colour them. */

import { createSvg } from "../dom";
import { sum } from "./algebra";
import { DIRECTIONS, hull, type Point } from "./hulls";
import type { Vector } from "./scene";
import { mark } from "./things";

/** A point of the world, m, in CSS pixels from the upper left corner of the picture. */
export type Project = (point: Vector) => number[];

export interface Ellipsoid {
  center: Vector;
  /** Half axes, m on the picture. */
  halfAxes: Vector;
  /** Unit vector of each half axis in the world. */
  directions: [Vector, Vector, Vector];
}

const CURVE_CORNERS = 48;

function trace(points: number[][], closed = false): string {
  return `M${points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L")}${closed ? "Z" : ""}`;
}

const group = (name: string, ...children: SVGElement[]): SVGElement => {
  const element = createSvg("g", { class: `overlay-${name}` });
  element.append(...children);
  return element;
};

/** Three principal curves, dashed before a lock; after the lock solid, over a filled outline. */
export function drawEllipsoid(project: Project, { center, halfAxes, directions }: Ellipsoid, when: "before" | "after"): SVGElement {
  const locate = (share: Vector): Vector =>
    share.reduce((point, x, k) => sum(point, directions[k], x * halfAxes[k]), center);
  const curves = [0, 1, 2].map((k) => {
    const corners = Array.from({ length: CURVE_CORNERS }, (_, j) => {
      const share: Vector = [0, 0, 0];
      share[(k + 1) % 3] = Math.cos((2 * Math.PI * j) / CURVE_CORNERS);
      share[(k + 2) % 3] = Math.sin((2 * Math.PI * j) / CURVE_CORNERS);
      return project(locate(share));
    });
    return createSvg("path", { d: trace(corners, true) });
  });
  if (when === "before") return group(when, ...curves);
  const outline = hull(DIRECTIONS.map((share) => project(locate(share)).slice(0, 2) as Point));
  return group(when, createSvg("path", { class: "overlay-fill", d: trace(outline, true) }), ...curves);
}

/** The direction of a twist that is lost: an arrow in both directions and a ring of a size, m, about the axis of rotation. */
export function drawLostDirection(project: Project, center: Vector, twist: number[], length: number): SVGElement {
  const { lines } = mark({ twist, words: "" }, center, length);
  const segments = lines.flatMap((_, k) => (k % 2 ? [] : [trace([project(lines[k]), project(lines[k + 1])])]));
  return group("lost", createSvg("path", { d: segments.join("") }));
}

/** The path of the tool. */
export function drawTrail(project: Project, points: Vector[], style: "solid" | "dotted" | "dashed"): SVGElement {
  return createSvg("path", { class: `overlay-trail overlay-${style}`, d: points.length ? trace(points.map(project)) : "" });
}

/** Text to the right of a point, whose class names its kind. */
export function drawLabel(project: Project, point: Vector, text: string, kind = "note"): SVGElement {
  const [x, y] = project(point);
  return createSvg("text", { class: `overlay-label overlay-${kind}`, x: (x + 14).toFixed(1), y: (y + 4).toFixed(1) }, text);
}

/** A padlock at a locked joint. */
export function drawPadlock(project: Project, joint: Vector): SVGElement {
  const [x, y] = project(joint);
  const lock = group("padlock", createSvg("path", { d: "M-4 -1V-5A4 4 0 0 1 4 -5V-1" }), createSvg("rect", { x: -7, y: -1, width: 14, height: 10, rx: 2 }));
  lock.setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
  return lock;
}

/** A dotted line from the tool to a target that it does not reach. */
export function drawGap(project: Project, tool: Vector, target: Vector): SVGElement {
  return createSvg("path", { class: "overlay-gap", d: trace([project(tool), project(target)]) });
}

/** The SVG element over the canvas of a view; pointers pass through it. */
export class Overlay {
  readonly element = createSvg("svg", { class: "view3d-overlay", "aria-hidden": "true" });

  constructor(canvas: HTMLCanvasElement) {
    canvas.after(this.element);
  }

  show(...elements: SVGElement[]): void {
    this.element.replaceChildren(...elements);
  }
}
