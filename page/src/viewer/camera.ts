/** Camera of a view, and the projection of points to the picture. */

import { cross, dot, level, sum } from "./algebra";
import type { Scene, Vector } from "./scene";

const HALF = Math.tan((14 * Math.PI) / 180); // of the angle of view
const STEEPEST = (89 * Math.PI) / 180;

export class Camera {
  azimuth = 0;
  elevation = 0;
  distance = 1;
  center: Vector = [0, 0, 0];
  private readonly east: Vector;
  private readonly north: Vector;

  constructor(private readonly scene: Scene) {
    [this.east, this.north] = level(scene.up);
    this.reset();
  }

  reset(): void {
    const { azimuth, elevation, center, radius } = this.scene.camera;
    this.azimuth = azimuth;
    this.elevation = elevation;
    this.center = center;
    this.distance = (1.04 * radius) / Math.sin(Math.atan(HALF));
  }

  turn(across: number, up: number): void {
    this.azimuth -= across;
    this.elevation = Math.min(Math.max(this.elevation + up, -STEEPEST), STEEPEST);
  }

  zoom(factor: number): void {
    const { radius } = this.scene.camera;
    this.distance = Math.min(Math.max(this.distance * factor, 0.4 * radius), 30 * radius);
  }

  /** Towards the eye, to the right and upward on the picture. */
  axes(): { back: Vector; right: Vector; top: Vector } {
    const [c, s] = [Math.cos(this.azimuth), Math.sin(this.azimuth)];
    const flat = sum(sum([0, 0, 0], this.east, c), this.north, s);
    const back = sum(sum([0, 0, 0], flat, Math.cos(this.elevation)), this.scene.up, Math.sin(this.elevation));
    const right = sum(sum([0, 0, 0], this.east, -s), this.north, c);
    return { back, right, top: cross(back, right) };
  }

  /** Lengths of the world, m, for a length on the picture, in heights of the picture. */
  get scale(): number {
    return 2 * HALF * this.distance;
  }

  pan(across: number, up: number): void {
    const { right, top } = this.axes();
    this.center = sum(sum(this.center, right, -across * this.scale), top, up * this.scale);
  }

  /** The matrix of the projection, column by column; `aspect` is width by height. A picture that is narrow shows as much. */
  matrix(aspect: number): Float32Array {
    const { back, right, top } = this.axes();
    const f = Math.min(aspect, 1) / HALF;
    const [near, far] = [0.05 * this.distance, this.distance + 40 * this.scene.camera.radius];
    const rows = [
      [...right.map((x) => (x * f) / aspect), (-dot(right, this.center) * f) / aspect],
      [...top.map((x) => x * f), -dot(top, this.center) * f],
    ];
    // Before the eye by distance - back . (p - center).
    const depth = [...back.map((x) => -x), this.distance + dot(back, this.center)];
    const a = (far + near) / (far - near);
    const third = depth.map((x, k) => a * x - (k === 3 ? (2 * far * near) / (far - near) : 0));
    const out = new Float32Array(16);
    [...rows, third, depth].forEach((row, i) => row.forEach((x, k) => (out[4 * k + i] = x)));
    return out;
  }

  get eye(): Vector {
    return sum(this.center, this.axes().back, this.distance);
  }
}

/** Where on a picture, in its pixels from the upper left corner, and how far before the eye. */
export function project(matrix: Float32Array, p: Vector, width: number, height: number): Vector {
  const row = (i: number): number => matrix[i] * p[0] + matrix[4 + i] * p[1] + matrix[8 + i] * p[2] + matrix[12 + i];
  const w = row(3);
  return [(0.5 + (0.5 * row(0)) / w) * width, (0.5 - (0.5 * row(1)) / w) * height, w];
}
