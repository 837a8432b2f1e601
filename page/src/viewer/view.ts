/** One view of an arm, which can be rotated and, if it has a motion, played. */

import { between, column, frames, place, sum } from "./algebra";
import { Camera, project } from "./camera";
import { controls } from "./controls";
import { Painter } from "./painter";
import type { Part, Scene, Vector } from "./scene";
import { triangles, type Triangles } from "./shapes";
import { cell, circle, edges, floor, joined, mark, triad } from "./things";

const RGB = (text: string): Vector => [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16) / 255) as Vector;
// After Okabe and Ito: dark for light pages, bright for dark ones.
const LIGHT = { ink: RGB("#1b1f24"), soft: RGB("#59636e"), faint: RGB("#d9dee3"), blue: RGB("#0a5c9e"), orange: RGB("#c8500a"), green: RGB("#007a5e"), purple: RGB("#a8497f"), paper: RGB("#ffffff") };
const DARK = { ink: RGB("#f2f4f6"), soft: RGB("#a9b3bd"), faint: RGB("#3a434c"), blue: RGB("#6cb4ee"), orange: RGB("#ff9a4d"), green: RGB("#3fcb9d"), purple: RGB("#e48fc0"), paper: RGB("#14181c") };

interface Label {
  text: string;
  at: Vector;
  color: Vector;
  strong?: boolean;
}

let shared: Painter | null = null;

/** What everything is drawn with, created again after the graphics card has lost it; throws without WebGL. */
function painter(): Painter {
  if (shared === null || shared.lost) shared = new Painter();
  return shared;
}

const css = (color: Vector, opacity = 1): string => `rgba(${color.map((x) => Math.round(255 * x)).join(",")},${opacity})`;

export class View {
  readonly camera: Camera;
  names: boolean | null = null;
  private at = 0; // frame of the motion, with its fraction
  private posed: number[] | null = null;
  private chosen = -1;
  private readonly shapes: { part: Part; shape: Triangles }[] = [];
  private trails: Vector[][] | null = null;
  private waiting = 0;
  private visible = false;
  private readonly floor: Vector[];
  private readonly show: (k: number) => void;

  /** Throws without WebGL; the static picture then stays in place. */
  constructor(
    readonly box: HTMLElement,
    readonly canvas: HTMLCanvasElement,
    readonly scene: Scene,
  ) {
    painter();
    this.camera = new Camera(scene);
    this.floor = floor(scene);
    this.listen();
    this.show = controls(this);
    new IntersectionObserver((seen) => {
      this.visible = seen[seen.length - 1].isIntersecting;
      this.draw();
    }).observe(canvas);
    new ResizeObserver(() => this.draw()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    new MutationObserver(() => this.draw()).observe(document.documentElement, { attributes: true });
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

  /** A frame of the motion, with its fraction. */
  frame(k: number): void {
    this.at = k;
    this.show(k);
    this.draw();
  }

  /** Configurations of the arms, rad and m. */
  configurations(): number[][] {
    return this.scene.arms.map((arm, k) => (k === 0 && this.posed) || between(arm.q, Math.min(this.at, arm.q.length - 1)));
  }

  /** Poses of the first arm: base, joints, tool. */
  frames(): number[][] {
    return frames(this.scene, this.configurations()[0]);
  }

  /** The sentence under the picture. */
  label(text: string): void {
    const said = this.box.querySelector(".view3d-said");
    if (said) said.textContent = text;
  }

  /** Draw as soon as the browser does. */
  draw(): void {
    this.waiting ||= requestAnimationFrame(() => {
      this.waiting = 0;
      if (!this.visible) return;
      try {
        if (this.paint()) this.box.classList.add("view3d-drawn"); // the drawing goes once there is something in its place
      } catch {
        this.box.classList.remove("view3d-live", "view3d-drawn"); // the graphics card is gone: the drawing is there
      }
    });
  }

  // ---- drawing -----------------------------------------------------------------------------------------------------

  /** Text about the failure of a joint; empty for a healthy one. */
  private condition(k: number | undefined): "locked" | "free" | null {
    const { free, locked, time } = this.scene;
    if (k === undefined) return null;
    if (free.includes(k)) return "free";
    const from = locked[k];
    if (from === null) return null;
    return !time.length || between(time.map((t) => [t]), this.at)[0] >= from - 1e-9 ? "locked" : null;
  }

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
      this.names = scene.arms.length === 1 && canvas.clientWidth >= 520;
      this.box.querySelector("[aria-pressed]")?.setAttribute("aria-pressed", String(this.names));
    }
    onto.clearRect(0, 0, width, height);
    const text = getComputedStyle(this.box).color.match(/[\d.]+/g)?.map(Number) ?? [0, 0, 0];
    const dark = text[0] + text[1] + text[2] > 384;
    const paint = dark ? DARK : LIGHT;
    const failed = { locked: paint.orange, free: paint.purple };
    const colors = [paint.ink, paint.green, paint.blue, paint.purple, paint.orange];
    const brush = painter();
    const matrix = camera.matrix(width / height);
    const { right } = camera.axes();
    brush.begin(width, height, matrix);
    if (!this.shapes.length) for (const part of scene.parts) this.shapes.push({ part, shape: triangles(part) });

    const places = this.configurations().map((q) => frames(scene, q));
    const bodies = (k: number, marks: boolean): { shape: Triangles; pose: number[]; color: Vector }[] =>
      this.shapes
        .filter(({ part }) => (marks ? part.mark && this.condition(part.joint) : !part.mark) && !(k && !part.frame))
        .map(({ part, shape }) => {
          const condition = this.condition(part.joint);
          const own = part.color.map((x) => (dark ? 0.25 + (0.75 * x) / 255 : x / 255)) as Vector;
          return { shape, pose: places[k][part.frame], color: condition ? failed[condition] : k ? colors[k % colors.length] : own };
        });
    const line = (points: Vector[], color: Vector, thick: number, opacity = 1): void =>
      brush.lines({ points, color, width: thick * ratio, opacity });

    line(this.floor, paint.faint, 1);
    brush.solids(bodies(0, false), camera.eye, scene.up, right);
    for (const box of scene.boxes) line(edges(box), paint.soft, 1.4);
    line(joined(scene.path), paint.orange, 1.8);
    if (scene.time.length) {
      this.trails ??= scene.arms.flatMap((arm) => [arm.q.map((q) => place(frames(scene, q).at(-1) as number[]))]);
      this.trails.forEach((trail, k) => {
        const gone = trail.slice(0, Math.floor(this.at) + 1);
        line(joined([...gone, place(places[k].at(-1) as number[])]), k ? colors[k % colors.length] : paint.blue, 2.4);
      });
    }
    brush.dots(scene.points, scene.colors.map((c) => c.map((x) => x / 255) as Vector), 7 * ratio);
    if (this.chosen >= 0) brush.dots([scene.points[this.chosen]], [paint.orange], 15 * ratio);
    for (let k = places.length - 1; k > 0; k--) brush.solids(bodies(k, false), camera.eye, scene.up, right, 0.5);

    const hand = places[0].at(-1) as number[];
    const labels: Label[] = [];
    brush.over(true);
    brush.solids(bodies(0, true), camera.eye, scene.up, right, 0.75);
    const axes = triad(hand, 0.12 * scene.size);
    [paint.orange, paint.green, paint.blue].forEach((color, k) => {
      line(axes[k], color, 2.6);
      labels.push({ text: "xyz"[k], at: sum(place(hand), column(hand, k), 0.14 * scene.size), color });
    });
    for (const target of scene.targets) {
      const reach = 0.09 * scene.size;
      triad(target, reach).forEach((points, k) => line(points, [paint.orange, paint.green, paint.blue][k], 1.6, 0.8));
      line(joined(circle(place(target), camera.axes().back, 0.35 * reach)), paint.orange, 2);
      labels.push({ text: "target", at: sum(place(target), scene.up, 0.4 * reach), color: paint.orange });
    }
    for (const lost of scene.lost) {
      const { lines, end } = mark(lost, place(hand), 0.26 * scene.size);
      line(lines, paint.orange, 3);
      labels.push({ text: lost.words, at: end, color: paint.orange, strong: true });
    }
    brush.over(false);
    brush.finish(onto, width, height);

    if (places.length > 1) {
      scene.arms.forEach((arm, k) => {
        const middle = place(places[k][Math.ceil(places[k].length / 2)]);
        labels.push({ text: arm.label, at: middle, color: colors[k % colors.length], strong: true });
      });
    }
    labels.push(...this.jointLabels(places[0], paint.ink, failed));
    if (this.names) labels.push(...scene.objects.map(({ name, at }) => ({ text: name, at, color: paint.soft })));
    this.write(onto, labels, matrix, ratio, paint.paper);
    onto.font = `${12 * ratio}px Arial, Helvetica, "Liberation Sans", sans-serif`;
    onto.fillStyle = css(paint.soft);
    onto.textAlign = "left";
    onto.fillText(`grid ${Number(cell(2 * scene.size).toPrecision(1))} m`, 8 * ratio, height - 9 * ratio);
    return true;
  }

  /** Names of joints; those at one place share a label. */
  private jointLabels(poses: number[][], ink: Vector, failed: Record<"locked" | "free", Vector>): Label[] {
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
        out.push({ text, at, color: condition ? failed[condition] : ink, strong: condition !== null });
      }
    });
    return out;
  }

  /** Text beside places, those nearest to the eye first; text that would overlap is omitted unless it is important. */
  private write(onto: CanvasRenderingContext2D, labels: Label[], matrix: Float32Array, ratio: number, paper: Vector): void {
    const { width, height } = onto.canvas;
    const tall = 12 * ratio;
    const taken: number[][] = [];
    const seen = labels.map((label) => ({ label, p: project(matrix, label.at, width, height) }));
    seen.sort((a, b) => Number(b.label.strong ?? false) - Number(a.label.strong ?? false) || a.p[2] - b.p[2]);
    onto.textAlign = "left";
    onto.textBaseline = "middle";
    onto.lineJoin = "round";
    for (const { label, p } of seen) {
      const letter = label.text.length < 2;
      onto.font = `${label.strong ? "bold " : ""}${tall}px Arial, Helvetica, "Liberation Sans", sans-serif`;
      const long = onto.measureText(label.text).width;
      const gap = 14 * ratio;
      const tries = letter
        ? [[p[0] - long / 2, p[1]]]
        : [
            [p[0] + gap, p[1]],
            [p[0] - gap - long, p[1]],
            [p[0] + gap, p[1] - 1.2 * tall],
            [p[0] - gap - long, p[1] + 1.2 * tall],
            [p[0] + gap, p[1] + 1.2 * tall],
            [p[0] - long / 2, p[1] - 2 * tall],
          ];
      const box = ([x, y]: number[]): number[] => [x, y - tall / 2, x + long, y + tall / 2];
      const free = tries.find((place) => {
        const [a, b, c, d] = box(place);
        const inside = a >= 0 && c <= width && b >= 0 && d <= height;
        return inside && taken.every(([x, y, z, w]) => c + tall < x || a > z + tall || d < y || b > w); // two labels next to each other would read as one
      });
      const chosen = free ?? (label.strong ? [Math.min(Math.max(tries[0][0], 0), width - long), tries[0][1]] : null);
      if (!chosen) continue;
      taken.push(box(chosen));
      onto.lineWidth = 4 * ratio;
      onto.strokeStyle = css(paper, 0.85);
      onto.strokeText(label.text, chosen[0], chosen[1]);
      onto.fillStyle = css(label.color);
      onto.fillText(label.text, chosen[0], chosen[1]);
    }
    onto.textBaseline = "alphabetic";
  }

  // ---- turning -----------------------------------------------------------------------------------------------------

  private listen(): void {
    const { canvas, camera } = this;
    const down = new Map<number, [number, number]>();
    let moved = 0;
    canvas.addEventListener("pointerdown", (event) => {
      down.set(event.pointerId, [event.clientX, event.clientY]);
      canvas.setPointerCapture(event.pointerId);
      moved = 0;
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = down.get(event.pointerId);
      if (!before) return;
      const [dx, dy] = [event.clientX - before[0], event.clientY - before[1]];
      moved += Math.abs(dx) + Math.abs(dy);
      const others = [...down].filter(([id]) => id !== event.pointerId).map(([, p]) => p);
      const tall = canvas.clientHeight;
      if (others.length) {
        const apart = (x: number, y: number): number => Math.hypot(x - others[0][0], y - others[0][1]) || 1;
        camera.zoom(apart(...before) / apart(event.clientX, event.clientY));
        camera.turn((2 * dx) / tall, (2 * dy) / tall);
      } else if (event.shiftKey || event.buttons & 6) {
        camera.pan(dx / tall, dy / tall);
      } else {
        camera.turn((4 * dx) / tall, (4 * dy) / tall);
      }
      down.set(event.pointerId, [event.clientX, event.clientY]);
      this.draw();
    });
    const up = (event: PointerEvent): void => {
      if (down.delete(event.pointerId) && event.type === "pointerup" && moved < 4) this.pick(event);
    };
    canvas.addEventListener("pointerup", up);
    canvas.addEventListener("pointercancel", up);
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener(
      "wheel",
      (event) => {
        // Scrolling the page past a view does not zoom it until the user has clicked the view.
        if (document.activeElement !== canvas && !event.ctrlKey) return;
        event.preventDefault();
        camera.zoom(Math.exp(0.0015 * event.deltaY));
        this.draw();
      },
      { passive: false },
    );
    const step = 0.1;
    const keys: Record<string, () => void> = {
      ArrowLeft: () => camera.turn(-step, 0),
      ArrowRight: () => camera.turn(step, 0),
      ArrowUp: () => camera.turn(0, step),
      ArrowDown: () => camera.turn(0, -step),
      "+": () => camera.zoom(0.9),
      "=": () => camera.zoom(0.9),
      "-": () => camera.zoom(1.1),
      "0": () => camera.reset(),
    };
    canvas.addEventListener("keydown", (event) => {
      const action = keys[event.key];
      if (!action || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      action();
      this.draw();
    });
  }

  /** Choose a point on a click, and report it. */
  private pick(event: PointerEvent): void {
    const { canvas, scene } = this;
    if (!scene.points.length) return;
    const matrix = this.camera.matrix(canvas.clientWidth / canvas.clientHeight);
    const bounds = canvas.getBoundingClientRect();
    let [best, nearest] = [-1, Infinity];
    scene.points.forEach((point, k) => {
      const p = project(matrix, point, canvas.clientWidth, canvas.clientHeight);
      const off = Math.hypot(p[0] - event.clientX + bounds.left, p[1] - event.clientY + bounds.top);
      if (off < 9 && p[2] < nearest) [best, nearest] = [k, p[2]];
    });
    if (best >= 0) this.choose(best);
  }

  /** Mark a point, and tell the page. */
  choose(k: number): void {
    this.chosen = k;
    this.box.dispatchEvent(new CustomEvent("view3d:point", { detail: k, bubbles: true }));
    this.draw();
  }}
