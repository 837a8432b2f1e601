/** Window (b) of Fig. 1: the commanded velocity, with its limit and its dead zone. */

import { circle, line, Surface } from "./canvas";
import { BLUE, FAINT, PALE, SOFT } from "./palette";
import { task } from "./projection";
import type { View } from "../experiment";

/** Radius of the limit circle, as a fraction of half the window's smaller side. */
const SHARE = 0.8;

export class VelocityWindow {
  readonly surface: Surface;

  /**
   * @param limit of the stick, m/cycle
   * @param deadZone of the stick, m/cycle
   */
  constructor(
    testid: string,
    label: string,
    readonly view: View,
    private readonly limit: number,
    private readonly deadZone: number,
  ) {
    this.surface = new Surface(testid, label);
  }

  /** Pixels from the middle to full deflection. */
  readonly reach = (): number => {
    const { clientWidth, clientHeight } = this.surface.element;
    return (SHARE * Math.min(clientWidth, clientHeight)) / 2;
  };

  draw(velocity: ArrayLike<number>): void {
    const c = this.surface.begin();
    const reach = this.reach();
    const thick = Math.max(2, reach / 70);
    const [x, y] = task(this.view, velocity).map((v) => (v / this.limit) * reach);
    circle(c, 0, 0, reach);
    c.fillStyle = "#ffffff";
    c.fill();
    c.lineWidth = thick;
    c.strokeStyle = SOFT;
    c.stroke();
    c.strokeStyle = FAINT;
    line(c, [-reach, 0], [reach, 0]);
    line(c, [0, -reach], [0, reach]);
    circle(c, 0, 0, (this.deadZone / this.limit) * reach);
    c.fillStyle = PALE;
    c.fill();
    c.strokeStyle = SOFT;
    c.stroke();
    c.strokeStyle = c.fillStyle = BLUE;
    c.lineWidth = 2 * thick;
    line(c, [0, 0], [x, y]);
    circle(c, x, y, 3.4 * thick);
    c.fillStyle = "#ffffff";
    c.fill();
    c.lineWidth = 1.6 * thick;
    c.stroke();
  }
}
