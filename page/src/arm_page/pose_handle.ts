/** A handle on the picture: a button that moves a pose by pointer or by keys, and three rings that rotate the pose. */

import { createSvg, h } from "../dom";
import { column, dot, place, rotation, sum, times } from "../viewer/algebra";
import type { Pose, Vector } from "../viewer/scene";
import { circle } from "../viewer/things";
import type { PageView } from "./page_view";

export interface HandleActions {
  begin?: () => void;
  move: (pose: Pose) => void;
  end?: () => void;
}

const COARSE_STEPS = 4; // small steps of a key without Shift
const KEY_STEP = 0.005; // of the stretched arm, for the smallest step by key
const KEY_ANGLE_RAD = 0.02;
const RING_RADIUS = 0.13; // of the stretched arm

interface Drag {
  pointer: number;
  x: number;
  y: number;
  pose: Pose;
  /** Axis of the ring, and the movement of its point at the pointer, pixels per rad; null for the button. */
  ring: { axis: number; tangent: number[] } | null;
}

export class PoseHandle {
  readonly button: HTMLButtonElement;
  private readonly rings: SVGElement;
  private pose: Pose = [];
  private drag: Drag | null = null;
  private rotating = false;

  /**
   * `labels` are what a screen reader says of the button while it moves the pose, and while it rotates the pose; `axes` are those
   * of the pose, 0 to 2, about which it can be rotated.
   */
  constructor(
    private readonly view: PageView,
    className: string,
    private readonly labels: [string, string],
    private readonly axes: number[],
    private readonly actions: HandleActions,
  ) {
    const properties = { type: "button", class: `pose-handle ${className}`, "aria-label": labels[0], hidden: true };
    this.button = h("button", properties);
    this.rings = createSvg("svg", { class: "view3d-overlay pose-rings", "aria-hidden": "true", hidden: "" });
    for (const axis of axes) {
      const ring = createSvg("path", { class: `ring-${"xyz"[axis]}` });
      this.listen(ring, () => ({ axis, tangent: this.findTangent(axis) }));
      this.rings.append(ring);
    }
    this.listen(this.button, () => null);
    this.button.addEventListener("keydown", (event) => this.key(event));
    this.button.addEventListener("keyup", (event) => {
      if (event.key in KEYS) actions.end?.();
    });
    view.canvas.parentElement?.append(this.rings, this.button);
  }

  /** Let arrow keys rotate the pose, and show the rings. */
  setRotating(on: boolean): void {
    this.rotating = on && this.axes.length > 0;
    this.button.setAttribute("aria-label", this.labels[Number(this.rotating)]);
    if (this.pose.length) this.place(this.pose);
  }

  /** Show the handle at a pose in the world; none hides it. */
  place(pose: Pose | null): void {
    this.pose = pose ?? this.pose;
    this.button.hidden = pose === null;
    this.rings.toggleAttribute("hidden", pose === null || !this.rotating);
    if (pose === null) return;
    const [x, y] = this.view.project(place(pose));
    this.button.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
    if (!this.rotating) return;
    [...this.rings.children].forEach((ring, k) => {
      const points = this.ringPoints(this.axes[k]).map(([a, b]) => `${a.toFixed(1)} ${b.toFixed(1)}`);
      ring.setAttribute("d", `M${points.join("L")}Z`);
    });
  }

  /** Points of a ring on the picture, which turn about the axis of the pose. */
  private ringPoints(axis: number): Vector[] {
    const ring = circle(place(this.pose), column(this.pose, axis), RING_RADIUS * this.view.scene.size);
    return ring.map((point) => this.view.project(point));
  }

  private pointer: [number, number] = [0, 0];

  /** Movement of the ring at the pointer, pixels per rad. */
  private findTangent(axis: number): number[] {
    const points = this.ringPoints(axis);
    const distance = ([x, y]: Vector): number => Math.hypot(x - this.pointer[0], y - this.pointer[1]);
    const nearest = points.reduce((best, point, k) => (distance(point) < distance(points[best]) ? k : best), 0);
    const [before, after] = [points.at(nearest - 1) as Vector, points[(nearest + 1) % points.length]];
    return [0, 1].map((k) => ((after[k] - before[k]) * points.length) / (4 * Math.PI));
  }

  private listen(element: Element, findRing: () => Drag["ring"]): void {
    const on = (type: string, action: (event: PointerEvent) => void): void =>
      element.addEventListener(type, (event) => action(event as PointerEvent));
    on("pointerdown", (event) => {
      if (this.drag) return; // a second finger does not take over
      const bounds = this.view.canvas.getBoundingClientRect();
      this.pointer = [event.clientX - bounds.left, event.clientY - bounds.top];
      this.actions.begin?.();
      this.drag = { pointer: event.pointerId, x: event.clientX, y: event.clientY, pose: [...this.pose], ring: findRing() };
      element.setPointerCapture(event.pointerId);
    });
    on("pointermove", (event) => this.follow(event));
    for (const type of ["pointerup", "pointercancel", "lostpointercapture"]) {
      on(type, (event) => {
        if (this.drag?.pointer !== event.pointerId) return;
        this.drag = null;
        this.actions.end?.();
      });
    }
  }

  private follow(event: PointerEvent): void {
    if (this.drag?.pointer !== event.pointerId) return;
    const { pose, ring, x, y } = this.drag;
    const [right, down] = [event.clientX - x, event.clientY - y];
    if (ring === null) return this.move(translate(pose, sum(this.view.displace(place(pose), right, down), place(pose), -1)));
    const [a, b] = ring.tangent;
    const axis: Vector = [0, 1, 2].map((k) => Number(k === ring.axis)) as Vector;
    this.move(times(pose, rotation(axis, (right * a + down * b) / (a * a + b * b || 1))));
  }

  private move(pose: Pose): void {
    this.pose = pose;
    this.actions.move(pose);
  }

  private key(event: KeyboardEvent): void {
    const direction = KEYS[event.key];
    if (!direction || !this.pose.length || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    const [right, up, gravity] = direction.map((step) => step * (event.shiftKey ? 1 : COARSE_STEPS));
    const axes = this.view.camera.axes();
    this.actions.begin?.();
    if (this.rotating) {
      const turn = sum(sum(sum([0, 0, 0], axes.top, right), axes.right, -up), axes.back, -gravity);
      const local = [0, 1, 2].map((k) => dot(column(this.pose, k), turn) / Math.hypot(...turn)) as Vector;
      return this.move(times(this.pose, rotation(local, KEY_ANGLE_RAD * Math.hypot(...turn))));
    }
    const flat = sum(sum([0, 0, 0], axes.right, right), axes.top, up);
    const step = sum(flat, this.view.scene.up, -gravity);
    this.move(translate(this.pose, sum([0, 0, 0], step, KEY_STEP * this.view.scene.size)));
  }
}

const translate = (pose: Pose, displacement: Vector): Pose =>
  pose.map((value, k) => (k % 4 === 3 ? value + displacement[(k - 3) / 4] : value));

/** To the right, upward on the picture, and along gravity; in rotations: about the upright, the level, and the line of sight. */
const KEYS: Record<string, Vector> = {
  ArrowLeft: [-1, 0, 0],
  ArrowRight: [1, 0, 0],
  ArrowUp: [0, 1, 0],
  ArrowDown: [0, -1, 0],
  PageUp: [0, 0, -1],
  PageDown: [0, 0, 1],
};
