/** Choice between WebGL, for arms among objects, and hulls in two dimensions, which need no graphics card. */

import { HullRenderer } from "./hulls";
import { Painter, SolidRenderer } from "./painter";
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

let painter: Painter | null = null;
let withoutCard = false;

/** The renderer of a picture of a scene. A WebGL context is created again after it is lost. */
export function chooseRenderer({ objects }: Scene, picture: Picture): HullRenderer {
  if (!withoutCard && objects.length) {
    try {
      if (!painter || painter.gl.isContextLost()) painter = new Painter();
      withoutCard = painter.software;
    } catch {
      withoutCard = true;
    }
    if (!withoutCard && painter) return new SolidRenderer(picture, painter);
  }
  return new HullRenderer(picture);
}
