/** Line plots as SVG, with axes, units, and a text alternative. */

import { createSvg } from "../dom";

export interface Curve {
  x: number[];
  y: number[];
  /** Largest value of the vertical axis, which begins at 0. */
  yMax: number;
  xLabel: string;
  yLabel: string;
  /** Texts at both ends of the horizontal axis. */
  xEnds: [string, string];
  /** Text of a height, for the top of the vertical axis. */
  format: (y: number) => string;
  /** Index of the marked sample. */
  marker: number;
  /** Height and label of a dotted horizontal line. */
  limit?: { y: number; label: string };
  /** Text alternative: first, last, and best value. */
  alternative: string;
}

const [WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM] = [360, 130, 48, 20, 8, 24];

/** Draw a curve with the marked sample as a circle. */
export function drawCurve(curve: Curve): SVGElement {
  const { x, y } = curve;
  const span = x[x.length - 1] - x[0] || 1;
  const across = (value: number): number => LEFT + ((value - x[0]) / span) * (WIDTH - LEFT - RIGHT);
  const upward = (value: number): number => HEIGHT - BOTTOM - (value / (curve.yMax || 1)) * (HEIGHT - TOP - BOTTOM);
  const svg = createSvg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "curve", role: "img", "aria-label": curve.alternative });
  const [floor, end] = [HEIGHT - BOTTOM, WIDTH - RIGHT];
  svg.append(createSvg("path", { class: "curve-axes", d: `M${LEFT} ${TOP}V${floor}H${end}` }));
  if (curve.limit && curve.limit.y <= curve.yMax) {
    const height = upward(curve.limit.y);
    svg.append(
      createSvg("path", { class: "curve-limit", d: `M${LEFT} ${height}H${end}` }),
      createSvg("text", { x: end, y: height + 12, "text-anchor": "end" }, curve.limit.label),
    );
  }
  const points = x.map((value, k) => `${across(value).toFixed(1)},${upward(y[k]).toFixed(1)}`).join(" ");
  svg.append(
    createSvg("polyline", { class: "curve-line", points }),
    createSvg("circle", { class: "curve-marker", cx: across(x[curve.marker]), cy: upward(y[curve.marker]), r: 5 }),
    createSvg("text", { x: LEFT, y: HEIGHT - 8 }, curve.xEnds[0]),
    createSvg("text", { x: (LEFT + end) / 2, y: HEIGHT - 8, "text-anchor": "middle" }, curve.xLabel),
    createSvg("text", { x: end, y: HEIGHT - 8, "text-anchor": "end" }, curve.xEnds[1]),
    createSvg("text", { x: LEFT - 4, y: TOP + 9, "text-anchor": "end" }, curve.format(curve.yMax)),
    createSvg("text", { x: LEFT - 4, y: floor, "text-anchor": "end" }, "0"),
    createSvg("text", { x: LEFT, y: TOP - 8 }, curve.yLabel),
  );
  return svg;
}
