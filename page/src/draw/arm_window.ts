/** Window (a) of Fig. 1: the arm as a wire frame, workspace boundary, start, target, and the path to the target. */

import { circle, line, Surface } from "./canvas";
import { BLUE, FAINT, INK, ORANGE, SKY, SOFT } from "./palette";
import { point, task } from "./projection";
import type { View } from "../experiment";

export interface ArmScene {
  /** Base, joints and tool point, m. */
  points: ArrayLike<number>;
  /** Task rows, m. */
  start: ArrayLike<number>;
  target: ArrayLike<number>;
  /** Radius of the target circle, m. */
  radius: number;
}

export class ArmWindow {
  readonly surface: Surface;

  /**
   * @param reach radius of the workspace's boundary, m; null where none is drawn
   * @param centre what is in the middle, m, along the view's axes
   * @param extent half of what must be seen, m
   */
  constructor(
    testid: string,
    label: string,
    private readonly view: View,
    private readonly reach: number | null,
    private readonly centre: [number, number],
    private readonly extent: number,
  ) {
    this.surface = new Surface(testid, label);
  }

  draw(scene: ArmScene): void {
    const c = this.surface.begin();
    const { width, height } = this.surface;
    const scale = Math.min(width, height) / 2 / (1.06 * this.extent);
    const [cx, cy] = this.centre;
    const place = ([x, y]: [number, number]): [number, number] => [(x - cx) * scale, (y - cy) * scale];
    const [start, target] = [scene.start, scene.target].map((v) => place(task(this.view, v)));
    const chain: [number, number][] = [];
    for (let k = 0; k < scene.points.length; k += 3) chain.push(place(point(this.view, scene.points, k)));
    const tip = chain[chain.length - 1];
    const thick = Math.max(2, Math.min(width, height) / 220);

    if (this.reach !== null) {
      circle(c, 0, 0, this.reach * scale);
      c.fillStyle = "#ffffff";
      c.fill();
      c.lineWidth = thick;
      c.strokeStyle = FAINT;
      c.stroke();
    }
    this.drawStart(c, start, thick);
    c.setLineDash([4 * thick, 3 * thick]);
    c.lineWidth = thick;
    c.strokeStyle = ORANGE;
    line(c, tip, target);
    c.setLineDash([]);
    circle(c, ...target, scene.radius * scale);
    c.lineWidth = 1.4 * thick;
    c.stroke();
    this.drawArm(c, chain, thick);
  }

  private drawStart(c: CanvasRenderingContext2D, [x, y]: [number, number], thick: number): void {
    const size = 3.5 * thick;
    c.lineWidth = thick;
    c.strokeStyle = SOFT;
    line(c, [x - size, y - size], [x + size, y + size]);
    line(c, [x - size, y + size], [x + size, y - size]);
  }

  private drawArm(c: CanvasRenderingContext2D, chain: [number, number][], thick: number): void {
    c.lineWidth = 2.2 * thick;
    c.strokeStyle = INK;
    line(c, ...chain);
    const [base, ...joints] = chain;
    c.fillStyle = INK;
    c.fillRect(base[0] - 4 * thick, base[1] - 4 * thick, 8 * thick, 8 * thick);
    for (const joint of joints.slice(0, -1)) {
      circle(c, ...joint, 2.6 * thick);
      c.fillStyle = SKY;
      c.fill();
      c.lineWidth = thick;
      c.stroke();
    }
    circle(c, ...chain[chain.length - 1], 3 * thick);
    c.fillStyle = BLUE;
    c.fill();
  }
}
