/** One view of an arm, which can be rotated and, if it has a motion, played. */

import { between, column, frames, place, sum } from "./algebra";
import { Camera, project } from "./camera";
import { listenToPointers } from "./gestures";
import { FONT, writeLabels, type Label } from "./labels";
import { choosePalette, css, type Palette } from "./palette";
import type { HullRenderer } from "./hulls";
import { chooseRenderer, type Body, type Picture } from "./renderer";
import type { Part, Pose, Scene, Vector } from "./scene";
import { cell, circle, edges, floor, joined, mark, triad } from "./things";

export type Condition = "locked" | "free" | null;

const POINT_RADIUS_PX = 9; // within which a click selects a point

export class View {
  readonly camera: Camera;
  /** Whether the names of the joints are shown; null until the width of the picture is known. */
  names: boolean | null = null;
  private at = 0; // frame of the motion, with its fraction
  private posed: number[] | null = null;
  private chosen = -1;
  private trails: Vector[][] | null = null;
  private waiting = 0;
  private visible = false;
  private readonly floor: Vector[];

  /** Throws without a canvas to draw on; the static picture then stays in place. */
  constructor(
    readonly box: HTMLElement,
    readonly canvas: HTMLCanvasElement,
    readonly scene: Scene,
  ) {
    if (!canvas.getContext("2d")) throw new Error("no canvas");
    this.camera = new Camera(scene);
    this.floor = floor(scene);
    listenToPointers(this);
    new IntersectionObserver((seen) => {
      this.visible = seen[seen.length - 1].isIntersecting;
      this.draw();
    }).observe(canvas);
    new ResizeObserver(() => this.draw()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    new MutationObserver(() => this.draw()).observe(document.documentElement, { attributes: true });
    box.classList.add("view3d-live");
  }

  // ---- from outside ------------------------------------------------------------------------------------------------

  /** Show the first arm at joint values, rad and m. */
  pose(q: number[]): void {
    this.posed = q;
    this.draw();
  }

  /** A frame of the motion, with its fraction. */
  frame(k: number): void {
    this.at = k;
    this.draw();
  }

  /** Configurations of the arms, rad and m. */
  configurations(): number[][] {
    return this.scene.arms.map((arm, k) => (k === 0 && this.posed) || between(arm.q, Math.min(this.at, arm.q.length - 1)));
  }

  /** Condition of a joint, from 0, at the shown frame; null for a healthy joint and for a link. */
  condition(k: number | undefined): Condition {
    const { free, locked, time } = this.scene;
    if (k === undefined) return null;
    if (free.includes(k)) return "free";
    const from = locked[k];
    if (from === null) return null;
    return !time.length || between(time.map((t) => [t]), this.at)[0] >= from - 1e-9 ? "locked" : null;
  }

  /** Poses of base, joints, and tool at a configuration. */
  protected solve(q: number[]): Pose[] {
    return frames(this.scene, q);
  }

  /** Poses of the first arm: base, joints, tool. */
  frames(): Pose[] {
    return this.solve(this.configurations()[0]);
  }

  /** A point of the world, m, in CSS pixels from the upper left corner of the canvas, and its distance before the eye, m. */
  project(point: Vector): Vector {
    const { clientWidth, clientHeight } = this.canvas;
    return project(this.camera.matrix(clientWidth / clientHeight), point, clientWidth, clientHeight);
  }

  /** Mark a point, and tell the page. */
  choose(k: number): void {
    this.chosen = k;
    this.box.dispatchEvent(new CustomEvent("view3d:point", { detail: k, bubbles: true }));
    this.draw();
  }

  /** Draw as soon as the browser does. */
  draw(): void {
    this.waiting ||= requestAnimationFrame(() => {
      this.waiting = 0;
      if (this.visible && this.paint()) this.finish();
    });
  }

  /** Called after each picture. */
  protected finish(): void {
    this.box.classList.add("view3d-drawn"); // the drawing goes once there is something in its place
  }

  /** Select the point of the scene at a place on the picture, CSS pixels; return false if there is none. */
  select(x: number, y: number): boolean {
    let [best, nearest] = [-1, Infinity];
    this.scene.points.forEach((point, k) => {
      const [px, py, depth] = this.project(point);
      if (Math.hypot(px - x, py - y) < POINT_RADIUS_PX && depth < nearest) [best, nearest] = [k, depth];
    });
    if (best >= 0) this.choose(best);
    return best >= 0;
  }

  // ---- drawing -----------------------------------------------------------------------------------------------------

  /** Return true if there was enough room and a canvas to draw on. */
  private paint(): boolean {
    const { canvas, scene, camera } = this;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    const onto = canvas.getContext("2d");
    if (!width || !height || !onto) return false;
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    if (this.names === null) {
      // Several arms, or a phone, leave too little room.
      this.names = scene.arms.length === 1 && canvas.clientWidth >= 520;
      this.box.querySelector("[aria-pressed]")?.setAttribute("aria-pressed", String(this.names));
    }
    onto.clearRect(0, 0, width, height);
    const palette = choosePalette(this.box);
    const matrix = camera.matrix(width / height);
    const picture: Picture = { onto, matrix, eye: camera.eye, up: scene.up, right: camera.axes().right, palette, ratio };
    const renderer = chooseRenderer(scene, picture);
    const poses = this.configurations().map((q) => this.solve(q));
    renderer.lines(this.floor, palette.faint, 1);
    // Without depths the opaque arm, which is the first one, is drawn last.
    const order = renderer.hidesFarther ? poses.keys() : [...poses.keys()].reverse();
    for (const k of order) renderer.solids(this.bodies(k, poses[k], palette), k ? 0.5 : 1);
    this.paintSurroundings(renderer, poses, palette);
    renderer.solids(this.bodies(0, poses[0], palette, true), 0.75, true);
    const labels = this.paintMarks(renderer, poses[0].at(-1) as Pose, palette);
    labels.push(...this.armLabels(poses, palette), ...this.jointLabels(poses[0], palette));
    if (this.names) labels.push(...scene.objects.map(({ name, at }) => ({ text: name, at, color: palette.soft })));
    this.write(labels, picture);
    return true;
  }

  /** Write labels, and the size of a cell of the floor. */
  protected write(labels: Label[], picture: Picture): void {
    const { onto, palette, ratio } = picture;
    writeLabels(labels, picture);
    onto.font = `${12 * ratio}px ${FONT}`;
    onto.fillStyle = css(palette.soft);
    onto.textAlign = "left";
    onto.fillText(`grid ${Number(cell(2 * this.scene.size).toPrecision(1))} m`, 8 * ratio, onto.canvas.height - 9 * ratio);
  }

  /** Colour of an arm; those after the first are drawn in one colour. */
  protected colorArm(arm: number, { ink, green, blue, purple, orange }: Palette): Vector {
    return [ink, green, blue, purple, orange][arm % 5];
  }

  /** Parts of an arm, or the marks of its failed joints. */
  private bodies(arm: number, poses: Pose[], palette: Palette, marks = false): Body[] {
    const parts = this.scene.parts.filter(
      (part) => (marks ? part.mark && this.condition(part.joint) : !part.mark) && !(arm && !part.frame),
    );
    return parts.map((part) => ({ part, pose: this.placePart(part, poses), color: this.colorPart(part, arm, palette) }));
  }

  /** Pose of a part in the world, for the poses of base, joints, and tool. */
  placePart(part: Part, poses: Pose[]): Pose {
    return poses[part.frame];
  }

  protected colorPart({ joint, color }: Part, arm: number, palette: Palette): Vector {
    const condition = this.condition(joint);
    if (condition) return { locked: palette.orange, free: palette.purple }[condition];
    return arm ? this.colorArm(arm, palette) : (color.map((x) => x / 255) as Vector);
  }

  /** Draw boxes, paths, and points. */
  private paintSurroundings(renderer: HullRenderer, poses: Pose[][], palette: Palette): void {
    const { scene } = this;
    for (const box of scene.boxes) renderer.lines(edges(box), palette.soft, 1.4);
    renderer.lines(joined(scene.path), palette.orange, 1.8);
    if (scene.time.length) {
      this.trails ??= scene.arms.map((arm) => arm.q.map((q) => place(this.solve(q).at(-1) as Pose)));
      this.trails.forEach((trail, k) => {
        const gone = trail.slice(0, Math.floor(this.at) + 1);
        renderer.lines(joined([...gone, place(poses[k].at(-1) as Pose)]), k ? this.colorArm(k, palette) : palette.blue, 2.4);
      });
    }
    renderer.dots(scene.points, scene.colors.map((c) => c.map((x) => x / 255) as Vector), 7);
    if (this.chosen >= 0) renderer.dots([scene.points[this.chosen]], [palette.orange], 15);
  }

  /** Draw the axes of the tool, targets, and lost directions; return their labels. */
  protected paintMarks(renderer: HullRenderer, tool: Pose, { orange, green, blue }: Palette): Label[] {
    const { scene, camera } = this;
    const labels: Label[] = [];
    const axes = triad(tool, 0.12 * scene.size);
    [orange, green, blue].forEach((color, k) => {
      renderer.lines(axes[k], color, 2.6);
      labels.push({ text: "xyz"[k], at: sum(place(tool), column(tool, k), 0.14 * scene.size), color });
    });
    for (const target of scene.targets) {
      const reach = 0.09 * scene.size;
      triad(target, reach).forEach((points, k) => renderer.lines(points, [orange, green, blue][k], 1.6, 0.8));
      renderer.lines(joined(circle(place(target), camera.axes().back, 0.35 * reach), true), orange, 2);
      labels.push({ text: "target", at: sum(place(target), scene.up, 0.4 * reach), color: orange });
    }
    for (const lost of scene.lost) {
      const { lines, end } = mark(lost, place(tool), 0.26 * scene.size);
      renderer.lines(lines, orange, 3);
      labels.push({ text: lost.words, at: end, color: orange, strong: true });
    }
    return labels;
  }

  private armLabels(poses: Pose[][], palette: Palette): Label[] {
    const { arms } = this.scene;
    if (arms.length < 2) return [];
    return arms.map(({ label }, k) => {
      const middle = place(poses[k][Math.ceil(poses[k].length / 2)]);
      return { text: label, at: middle, color: this.colorArm(k, palette), strong: true };
    });
  }

  /** Names of joints; those at one place share a label. */
  private jointLabels(poses: Pose[], { ink, orange, purple }: Palette): Label[] {
    const out: Label[] = [];
    this.scene.joints.forEach((joint, k) => {
      const condition = this.condition(k);
      if (!this.names && !condition) return;
      const at = place(poses[k + 1]);
      const text = condition ? `${joint.name} ${condition}` : joint.name;
      const near = out.find((l) => !l.strong && !condition && Math.hypot(...sum(l.at, at, -1)) < 0.01 * this.scene.size);
      if (near) {
        near.text = `${near.text}, ${text}`;
      } else {
        out.push({ text, at, color: condition ? { locked: orange, free: purple }[condition] : ink, strong: condition !== null });
      }
    });
    return out;
  }
}
