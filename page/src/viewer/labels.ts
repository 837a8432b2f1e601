/** Text on a picture. */

import { project } from "./camera";
import { css } from "./palette";
import type { Picture } from "./renderer";
import type { Vector } from "./scene";

export interface Label {
  text: string;
  at: Vector;
  color: Vector;
  strong?: boolean;
}

export const FONT = 'Arial, Helvetica, "Liberation Sans", sans-serif';

/** Write text beside places, those nearest to the eye first; text that would overlap is omitted unless it is important. */
export function writeLabels(labels: Label[], { onto, matrix, palette: { paper }, ratio }: Picture): void {
  const { width, height } = onto.canvas;
  const tall = 12 * ratio;
  const taken: number[][] = [];
  const seen = labels.map((label) => ({ label, p: project(matrix, label.at, width, height) }));
  seen.sort((a, b) => Number(b.label.strong ?? false) - Number(a.label.strong ?? false) || a.p[2] - b.p[2]);
  onto.textAlign = "left";
  onto.textBaseline = "middle";
  onto.lineJoin = "round";
  for (const { label, p } of seen) {
    onto.font = `${label.strong ? "bold " : ""}${tall}px ${FONT}`;
    const long = onto.measureText(label.text).width;
    const gap = 14 * ratio;
    const besides = [0, -1.2, 1.2].flatMap((lines) =>
      [p[0] + gap, p[0] - gap - long].map((x) => [x, p[1] + lines * tall]),
    );
    const tries = label.text.length < 2 ? [[p[0] - long / 2, p[1]]] : besides;
    const box = ([x, y]: number[]): number[] => [x, y - tall / 2, x + long, y + tall / 2];
    const free = tries.find((place) => {
      const [a, b, c, d] = box(place);
      const inside = a >= 0 && c <= width && b >= 0 && d <= height;
      // Two labels next to each other would read as one.
      return inside && taken.every(([x, y, z, w]) => c + tall < x || a > z + tall || d < y || b > w);
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
