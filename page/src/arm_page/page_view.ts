/** The view on a page: the page says what it shows, and places its own controls and labels around and over it. */

import { sum, times } from "../viewer/algebra";
import type { Label } from "../viewer/labels";
import type { Palette } from "../viewer/palette";
import type { Picture } from "../viewer/renderer";
import type { Part, Pose, Scene, Vector } from "../viewer/scene";
import { View, type Condition } from "../viewer/view";
import type { ArmModel } from "./arm_model";

export type GhostColor = "green" | "orange" | "purple" | "blue";

/** Configurations of the arm and of further, transparent arms, rad and m, and the condition of each joint. */
export interface Shown {
  q: number[];
  ghosts: number[][];
  ghostColors: GhostColor[];
  conditions: Condition[];
}

export class PageView extends View {
  /** Called after each picture, for example to place what lies over the canvas. */
  onDraw: (() => void) | null = null;
  /** Called after a click on the picture with its place, CSS pixels, unless it is on a point of the scene. */
  onClick: ((place: number[]) => void) | null = null;
  override names: boolean | null = false;
  /** Motion of each object of the cell from its place in the scene, in the world. */
  objectMotions: Pose[] = [];
  /** Index of the object that the arm touches; -1 for none. */
  touchedObject = -1;
  private shown: Shown = { q: this.scene.arms[0].q[0], ghosts: [], ghostColors: [], conditions: [] };
  private readonly objects = this.scene.parts.filter((part) => part.object);

  constructor(box: HTMLElement, canvas: HTMLCanvasElement, scene: Scene, private readonly arm: ArmModel) {
    super(box, canvas, scene);
  }

  show(shown: Shown): void {
    this.shown = shown;
    this.draw();
  }

  /** Index of the object that a part shows; -1 for a part of the arm. */
  objectIndex(part: Part): number {
    return this.objects.indexOf(part);
  }

  override configurations(): number[][] {
    return [this.shown.q, ...this.shown.ghosts];
  }

  override condition(joint: number | undefined): Condition {
    return (joint !== undefined && this.shown.conditions[joint]) || null;
  }

  protected override solve(q: number[]): Pose[] {
    return this.arm.frames(q).map((pose) => [...pose]);
  }

  /** A point of the world, m, moved parallel to the picture by CSS pixels to the right and downward. */
  displace(point: Vector, across: number, down: number): Vector {
    const { right, top } = this.camera.axes();
    const { clientWidth, clientHeight } = this.canvas;
    const pixel = (this.camera.scale * this.project(point)[2]) / this.camera.distance / Math.min(clientWidth, clientHeight);
    return sum(sum(point, right, across * pixel), top, -down * pixel);
  }

  override placePart(part: Part, poses: Pose[]): Pose {
    const [pose, motion] = [super.placePart(part, poses), this.objectMotions[this.objectIndex(part)]];
    return motion ? times(motion, pose) : pose;
  }

  protected override colorPart(part: Part, arm: number, palette: Palette): Vector {
    return part.object && this.objectIndex(part) === this.touchedObject ? palette.orange : super.colorPart(part, arm, palette);
  }

  protected override colorArm(arm: number, palette: Palette): Vector {
    return palette[this.shown.ghostColors[arm - 1]] ?? super.colorArm(arm, palette);
  }

  protected override paintMarks(): Label[] {
    return [];
  }

  protected override write(labels: Label[], picture: Picture): void {
    if (this.names) super.write(labels, picture);
  }

  protected override finish(): void {
    super.finish();
    this.onDraw?.();
  }

  override select(x: number, y: number): boolean {
    if (super.select(x, y)) return true;
    this.onClick?.([x, y]);
    return false;
  }
}
