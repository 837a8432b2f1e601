/** One view of an arm, which can be rotated and, if it has a motion, played. */

import { between, column, frames, place, sum, times } from "./algebra";
import { Camera, project } from "./camera";
import { controls } from "./controls";
import { listenToPointers } from "./gestures";
import { findBody } from "./hulls";
import { writeLabels, type Label } from "./labels";
import { choosePalette, css, type Palette } from "./palette";
import { chooseRenderer, type Body, type Picture, type Renderer } from "./renderer";
import type { Part, Pose, Scene, Vector } from "./scene";
import { cell, circle, edges, floor, joined, mark, triad } from "./things";

export type Condition = "locked" | "free" | null;
export type GhostColor = "green" | "orange" | "purple" | "blue";

export interface ViewOptions {
  /** Poses of base, joints, and tool at a configuration; computed from the joints of the scene if absent. */
  frames?: (q: number[]) => Pose[];
  /** Draw arms and floor only, without labels and controls, because the page has its own. */
  plain?: boolean;
}

export class View {
  readonly camera: Camera;
  /** Called after each picture, for example to place what lies over the canvas. */
  onDraw: (() => void) | null = null;
  /** Called after a click on the body of a joint or on an object around the arm. */
  onPick: ((part: Part) => void) | null = null;
  /** Motion of each object of the cell from its place in the scene, in the world. */
  objectMotions: Pose[] = [];
  /** Index of the object that the arm touches; -1 for none. */
  touchedObject = -1;
  names: boolean | null = null;
  private at = 0; // frame of the motion, with its fraction
  private posed: number[] | null = null;
  private ghosts: number[][] | null = null;
  private ghostColors: GhostColor[] = [];
  private conditions: Condition[] | null = null;
  private chosen = -1;
  private trails: Vector[][] | null = null;
  private waiting = 0;
  private visible = false;
  private readonly floor: Vector[];
  /** Parts of the objects around the arm. */
  readonly objects: Part[];
  private readonly show: (k: number) => void;
  private readonly solve: (q: number[]) => Pose[];

  /** Throws without a canvas to draw on; the static picture then stays in place. */
  constructor(
    readonly box: HTMLElement,
    readonly canvas: HTMLCanvasElement,
    readonly scene: Scene,
    private readonly options: ViewOptions = {},
  ) {
    if (!canvas.getContext("2d")) throw new Error("no canvas");
    this.solve = options.frames ?? ((q) => frames(scene, q));
    this.camera = new Camera(scene);
    this.floor = floor(scene);
    this.objects = scene.parts.filter((part) => part.object);
    listenToPointers(this);
    this.show = options.plain ? () => undefined : controls(this);
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

  /** Number of frames of the motion. */
  get length(): number {
    return Math.max(...this.scene.arms.map((arm) => arm.q.length));
  }

  /** Show the first arm at joint values, rad and m; without values, at its place in the motion. */
  pose(q: number[] | null): void {
    this.posed = q;
    this.draw();
  }

  /** Show other configurations, rad and m, as transparent arms; null for those of the scene. */
  setGhosts(ghosts: number[][] | null, colors: GhostColor[] = []): void {
    [this.ghosts, this.ghostColors] = [ghosts, colors];
    this.draw();
  }

  /** Set for each joint whether it is locked or swings freely; null for the conditions in the scene. */
  setConditions(conditions: Condition[] | null): void {
    this.conditions = conditions;
    this.draw();
  }

  /** A frame of the motion, with its fraction. */
  frame(k: number): void {
    this.at = k;
    this.show(k);
    this.draw();
  }

  /** Configurations of the arms, rad and m. */
  configurations(): number[][] {
    const all = this.scene.arms.map((arm, k) => (k === 0 && this.posed) || between(arm.q, Math.min(this.at, arm.q.length - 1)));
    return this.ghosts ? [all[0], ...this.ghosts] : all;
  }

  /** Condition of a joint, from 0, at the shown frame; null for a healthy joint and for a link. */
  condition(k: number | undefined): Condition {
    const { free, locked, time } = this.scene;
    if (k === undefined) return null;
    if (this.conditions) return this.conditions[k];
    if (free.includes(k)) return "free";
    const from = locked[k];
    if (from === null) return null;
    return !time.length || between(time.map((t) => [t]), this.at)[0] >= from - 1e-9 ? "locked" : null;
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

  /** A point of the world, m, moved parallel to the picture by CSS pixels to the right and downward. */
  displace(point: Vector, across: number, down: number): Vector {
    const { right, top } = this.camera.axes();
    const { clientWidth, clientHeight } = this.canvas;
    const pixel = (this.camera.scale * this.project(point)[2]) / this.camera.distance / Math.min(clientWidth, clientHeight);
    return sum(sum(point, right, across * pixel), top, -down * pixel);
  }

  /** The sentence under the picture. */
  label(text: string): void {
    const said = this.box.querySelector(".view3d-said");
    if (said) said.textContent = text;
  }

  /** Mark a point, and tell the page. */
  choose(k: number): void {
    this.chosen = k;
    this.box.dispatchEvent(new CustomEvent("view3d:point", { detail: k, bubbles: true }));
    this.draw();
  }

  /** Report the joint or the object at a point of the picture, CSS pixels. */
  pick(point: number[]): void {
    const bodies = this.placeParts(this.scene.parts.filter((part) => part.joint !== undefined || part.object), this.frames());
    const found = this.onPick && findBody(bodies, (corner) => this.project(corner), point);
    if (found) this.onPick?.(found.part);
  }

  /** Mark no point of the scene. */
  unchoose(): void {
    this.chosen = -1;
  }

  /** Draw as soon as the browser does. */
  draw(): void {
    this.waiting ||= requestAnimationFrame(() => {
      this.waiting = 0;
      if (!this.visible || !this.paint()) return;
      this.box.classList.add("view3d-drawn"); // the drawing goes once there is something in its place
      this.onDraw?.();
    });
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
      // Several arms, or a phone, leave too little room; the width of the page is known only now.
      this.names = scene.arms.length === 1 && canvas.clientWidth >= 520 && !this.options.plain;
      this.box.querySelector("[aria-pressed]")?.setAttribute("aria-pressed", String(this.names));
    }
    onto.clearRect(0, 0, width, height);
    const palette = choosePalette(this.box);
    const matrix = camera.matrix(width / height);
    const picture: Picture = { onto, matrix, eye: camera.eye, up: scene.up, right: camera.axes().right, palette };
    const renderer = chooseRenderer(scene, picture);
    const poses = this.configurations().map(this.solve);
    renderer.lines({ points: this.floor, color: palette.faint, width: ratio });
    const paintGhosts = (): void => {
      for (let k = poses.length - 1; k > 0; k--) renderer.solids(this.bodies(k, poses[k], palette), 0.5);
    };
    if (!renderer.hidesFarther) paintGhosts();
    renderer.solids(this.bodies(0, poses[0], palette));
    this.paintSurroundings(renderer, poses, palette, ratio);
    if (renderer.hidesFarther) paintGhosts();
    renderer.over(true);
    renderer.solids(this.bodies(0, poses[0], palette, true), 0.75);
    const labels = this.options.plain ? [] : this.paintMarks(renderer, poses[0].at(-1) as Pose, palette, ratio);
    renderer.over(false);
    renderer.finish();
    if (this.options.plain && !this.names) return true;
    labels.push(...this.armLabels(poses, palette), ...this.jointLabels(poses[0], palette));
    if (this.names) labels.push(...scene.objects.map(({ name, at }) => ({ text: name, at, color: palette.soft })));
    writeLabels(labels, picture, ratio);
    onto.font = `${12 * ratio}px Arial, Helvetica, "Liberation Sans", sans-serif`;
    onto.fillStyle = css(palette.soft);
    onto.textAlign = "left";
    onto.fillText(`grid ${Number(cell(2 * scene.size).toPrecision(1))} m`, 8 * ratio, height - 9 * ratio);
    return true;
  }

  /** Colours of the arms: those after the first are drawn in one colour. */
  private colors({ ink, green, blue, purple, orange }: Palette): Vector[] {
    return [ink, green, blue, purple, orange];
  }

  /** Parts of an arm, or the marks of its failed joints. */
  private bodies(arm: number, poses: Pose[], palette: Palette, marks = false): Body[] {
    const failed = { locked: palette.orange, free: palette.purple };
    const ghost = palette[this.ghostColors[arm - 1]] ?? this.colors(palette)[arm % 5];
    const parts = this.scene.parts.filter(
      (part) => (marks ? part.mark && this.condition(part.joint) : !part.mark) && !(arm && !part.frame),
    );
    return this.placeParts(parts, poses).map(({ part, pose }) => {
      const condition = this.condition(part.joint);
      const own = part.color.map((x) => x / 255) as Vector;
      const touched = part.object && this.objects.indexOf(part) === this.touchedObject;
      return { part, pose, color: touched ? palette.orange : condition ? failed[condition] : arm ? ghost : own };
    });
  }

  /** The pose of each part in the world; objects of the cell may have moved. */
  private placeParts(parts: Part[], poses: Pose[]): Pick<Body, "part" | "pose">[] {
    return parts.map((part) => {
      const moved = part.object && this.objectMotions[this.objects.indexOf(part)];
      return { part, pose: moved ? times(moved, poses[part.frame]) : poses[part.frame] };
    });
  }

  /** Draw boxes, paths, and points. */
  private paintSurroundings(renderer: Renderer, poses: Pose[][], palette: Palette, ratio: number): void {
    const { scene } = this;
    const line = (points: Vector[], color: Vector, thick: number): void =>
      renderer.lines({ points, color, width: thick * ratio });
    for (const box of scene.boxes) line(edges(box), palette.soft, 1.4);
    line(joined(scene.path), palette.orange, 1.8);
    if (scene.time.length && !this.ghosts) {
      this.trails ??= scene.arms.map((arm) => arm.q.map((q) => place(this.solve(q).at(-1) as Pose)));
      this.trails.forEach((trail, k) => {
        const gone = trail.slice(0, Math.floor(this.at) + 1);
        line(joined([...gone, place(poses[k].at(-1) as Pose)]), k ? this.colors(palette)[k % 5] : palette.blue, 2.4);
      });
    }
    renderer.dots(scene.points, scene.colors.map((c) => c.map((x) => x / 255) as Vector), 7 * ratio);
    if (this.chosen >= 0) renderer.dots([scene.points[this.chosen]], [palette.orange], 15 * ratio);
  }

  /** Draw the axes of the tool, targets, and lost directions; return their labels. */
  private paintMarks(renderer: Renderer, tool: Pose, { orange, green, blue }: Palette, ratio: number): Label[] {
    const { scene, camera } = this;
    const line = (points: Vector[], color: Vector, thick: number, opacity = 1): void =>
      renderer.lines({ points, color, width: thick * ratio, opacity });
    const labels: Label[] = [];
    const axes = triad(tool, 0.12 * scene.size);
    [orange, green, blue].forEach((color, k) => {
      line(axes[k], color, 2.6);
      labels.push({ text: "xyz"[k], at: sum(place(tool), column(tool, k), 0.14 * scene.size), color });
    });
    for (const target of scene.targets) {
      const reach = 0.09 * scene.size;
      triad(target, reach).forEach((points, k) => line(points, [orange, green, blue][k], 1.6, 0.8));
      line(joined(circle(place(target), camera.axes().back, 0.35 * reach)), orange, 2);
      labels.push({ text: "target", at: sum(place(target), scene.up, 0.4 * reach), color: orange });
    }
    for (const lost of scene.lost) {
      const { lines, end } = mark(lost, place(tool), 0.26 * scene.size);
      line(lines, orange, 3);
      labels.push({ text: lost.words, at: end, color: orange, strong: true });
    }
    return labels;
  }

  private armLabels(poses: Pose[][], palette: Palette): Label[] {
    if (this.ghosts || poses.length < 2) return [];
    return this.scene.arms.map((arm, k) => {
      const middle = place(poses[k][Math.ceil(poses[k].length / 2)]);
      return { text: arm.label, at: middle, color: this.colors(palette)[k % 5], strong: true };
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
