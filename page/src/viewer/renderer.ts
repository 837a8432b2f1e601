/** Choice between WebGL, for scenes with surroundings, and hulls in two dimensions, which need no graphics card. */

import { HullRenderer } from "./hulls";
import { Painter } from "./painter";
import type { Palette } from "./palette";
import type { Part, Pose, Scene, Vector } from "./scene";

export interface Picture {
  onto: CanvasRenderingContext2D;
  /** Projection of the camera, column by column. */
  matrix: Float32Array;
  eye: Vector;
  up: Vector;
  right: Vector;
  palette: Palette;
  /** Pixels of the canvas for a CSS pixel. */
  ratio: number;
}

export interface Body {
  part: Part;
  pose: Pose;
  /** Each channel from 0 to 1. */
  color: Vector;
}

export interface Renderer {
  /** Whether near shapes hide those behind them in any order; otherwise a shape covers those before it. */
  readonly hidesFarther: boolean;
  solids(bodies: Body[], opacity?: number): void;
  /** Draw segments between pairs of points; `width` in CSS pixels. */
  lines(points: Vector[], color: Vector, width: number, opacity?: number): void;
  /** Draw discs; `width` in CSS pixels. */
  dots(points: Vector[], colors: Vector[], width: number): void;
  /** Subsequent shapes cover all others while this is on. */
  over(on: boolean): void;
  finish(): void;
}

let painter: Painter | null = null;
let withoutCard = false;

/** The renderer of a picture of a scene. A WebGL renderer is created again after its context is lost. */
export function chooseRenderer({ objects, points, boxes }: Scene, picture: Picture): Renderer {
  if (!withoutCard && objects.length + points.length + boxes.length) {
    try {
      if (!painter || painter.lost) painter = new Painter();
      withoutCard = painter.software;
    } catch {
      withoutCard = true;
    }
    if (!withoutCard && painter) return painter.begin(picture);
  }
  return new HullRenderer(picture);
}
