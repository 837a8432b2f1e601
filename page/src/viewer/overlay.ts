/** SVG over the picture of an arm: ellipsoids, lost directions, trails, locks, and labels; CSS classes colour them. */

import type { Ellipsoid } from "../arm_page/failures";
import { createSvg } from "../dom";
import { place, sum } from "./algebra";
import { project } from "./camera";
import { hull, spreadDirections } from "./hulls";
import type { Lost, Vector } from "./scene";
import { mark } from "./things";
import type { View } from "./view";

interface DrawnEllipsoid extends Ellipsoid {
  center: Vector;
  /** Before or after the lock. */
  style: "before" | "after";
}

export interface Trail {
  points: Vector[];
  style: "solid" | "dotted" | "dashed" | "green" | "orange" | "purple";
}

/** What lies over a picture, in the world. */
export interface OverlayContent {
  ellipsoids?: DrawnEllipsoid[];
  trails?: Trail[];
  lost?: (Lost & { center: Vector })[];
  /** A dotted line from the tool to where the pointer wants it. */
  pointerLine?: [Vector, Vector];
  /** The shortest distance from the arm to an object. */
  nearestLine?: [Vector, Vector];
}

/** From a point of the world, m, to CSS pixels from the upper left corner of the picture. */
export type Project = (point: Vector) => number[];

const ELLIPSOID_SCALE_S = 0.4; // metres on the picture for a half axis of 1 m/s
const LOST_LENGTH = 0.26; // of the stretched arm
const LETTER_PX = 8.5; // width of a letter of a label, at most on average
const CURVE_CORNERS = 48;
const SURFACE = spreadDirections(160);

function formatPath(points: number[][], closed = false): string {
  return `M${points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L")}${closed ? "Z" : ""}`;
}

const group = (name: string, ...children: SVGElement[]): SVGElement => {
  const element = createSvg("g", { class: `overlay-${name}` });
  element.append(...children);
  return element;
};

/** Draw three principal curves, and the filled outline of the ellipsoid after a lock. */
function drawEllipsoid(locate: Project, { center, halfAxes, directions, style }: DrawnEllipsoid): SVGElement {
  const placeShare = (share: Vector): number[] =>
    locate(share.reduce((point, x, k) => sum(point, directions[k], x * ELLIPSOID_SCALE_S * halfAxes[k]), center));
  const curves = [0, 1, 2].map((k) =>
    Array.from({ length: CURVE_CORNERS }, (_, j) => {
      const share: Vector = [0, 0, 0];
      share[(k + 1) % 3] = Math.cos((2 * Math.PI * j) / CURVE_CORNERS);
      share[(k + 2) % 3] = Math.sin((2 * Math.PI * j) / CURVE_CORNERS);
      return placeShare(share);
    }),
  );
  const paths = curves.map((curve) => createSvg("path", { d: formatPath(curve, true) }));
  if (style === "before") return group("ellipsoid overlay-before", ...paths);
  const outline = hull([...curves.flat(), ...SURFACE.map(placeShare)]);
  return group("ellipsoid overlay-after", createSvg("path", { class: "overlay-fill", d: formatPath(outline, true) }), ...paths);
}

/** Draw a lost motion: arrows in both directions, a ring about the axis of rotation, and a label within the width in pixels. */
function drawLostMotion(locate: Project, lost: Lost, center: Vector, length: number, width: number): SVGElement {
  const { lines, end } = mark(lost, center, length);
  const segments = lines.flatMap((start, k) => (k % 2 ? [] : [formatPath([locate(start), locate(lines[k + 1])])]));
  const [x, y] = locate(end);
  const left = Math.min(x + 10, width - LETTER_PX * lost.words.length);
  const text = createSvg("text", { class: "overlay-label", x: left.toFixed(1), y: (y - 6).toFixed(1) }, lost.words);
  return group("lost", createSvg("path", { d: segments.join("") }), text);
}

function drawTrail(locate: Project, { points, style }: Trail): SVGElement {
  return createSvg("path", { class: `overlay-trail overlay-${style}`, d: formatPath(points.map(locate)) });
}

function drawPadlock(locate: Project, joint: Vector): SVGElement {
  const [x, y] = locate(joint);
  const [shackle, body] = ["M-4 -1V-5A4 4 0 0 1 4 -5V-1", "M-7 -1H7V9H-7Z"];
  const lock = group("padlock", createSvg("path", { d: shackle }), createSvg("path", { class: "overlay-fill", d: body }));
  lock.setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
  return lock;
}

/** An SVG element over the canvas of a view; pointers pass through it. */
export class Overlay {
  readonly element = createSvg("svg", { class: "view3d-overlay", "aria-hidden": "true" });

  constructor(private readonly view: View) {
    view.canvas.after(this.element);
  }

  /** Show the content, and a padlock at each locked joint. */
  show({ ellipsoids = [], trails = [], lost = [], pointerLine, nearestLine }: OverlayContent): void {
    const { view } = this;
    const { clientWidth, clientHeight } = view.canvas;
    const matrix = view.camera.matrix(clientWidth / clientHeight);
    const locate: Project = (point) => project(matrix, point, clientWidth, clientHeight);
    const poses = view.frames();
    this.element.replaceChildren(
      ...ellipsoids.map((ellipsoid) => drawEllipsoid(locate, ellipsoid)),
      ...trails.map((trail) => drawTrail(locate, trail)),
      ...lost.map((motion) => drawLostMotion(locate, motion, motion.center, LOST_LENGTH * view.scene.size, clientWidth)),
      ...view.scene.joints.flatMap((_, k) => (view.condition(k) === "locked" ? [drawPadlock(locate, place(poses[k + 1]))] : [])),
      ...[["gap", pointerLine], ["nearest", nearestLine]].flatMap(([name, line]) =>
        line ? [createSvg("path", { class: `overlay-${name}`, d: formatPath((line as Vector[]).map(locate)) })] : []),
    );
  }
}
