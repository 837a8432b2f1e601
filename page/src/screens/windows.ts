/** The two windows of Fig. 1, one pair for each view: the arm with its target, and the commanded velocity. */

import { createSvg, h } from "../dom";
import type { Device } from "../input/device";
import type { TrainingTask } from "../messages";
import { projectPoint, projectTask } from "../projection";
import type { Station } from "../station";
import type { Stick } from "../stick";

/** Smallest width of a line, px. */
const LINE_WIDTH_PX = 2;
/** Half of the smaller side of a large window, in line widths. */
const HALF_SIDES = { arm: 110, velocity: 87.5 };
/** Half of the smaller side of an arm window relative to the visible extent. */
const BORDER_FACTOR = 1.06;
/** Factor on the extent of all arms and targets, which leaves a margin around them. */
const MARGIN_FACTOR = 1.1;
/** Distance from the middle of a velocity window to full deflection, as a fraction of half of the window's smaller side. */
export const REACH_FRACTION = 0.8;

type Point = [x: number, y: number];

/** Data of a station that the windows need; the experimenter's page has them too. */
export type Drawn = Pick<Station, "experiment" | "texts" | "arm"> & { plan: { training: Pose[]; trials: Pose[] } };

type Pose = Pick<TrainingTask, "q0" | "target">;

/** Drawings of one kind, one for each view, and the captioned windows that contain them. */
class Windows {
  readonly drawings: SVGElement[];
  readonly elements: HTMLElement[];

  constructor(protected readonly station: Drawn, private readonly kind: "arm" | "velocity") {
    const { texts, experiment: { views } } = station;
    const name = texts.get(`${kind}_window`);
    const attributes = { role: "img", "aria-label": texts.get(`${kind}_window_says`) };
    this.drawings = views.map((_, k) => createSvg("svg", { ...attributes, "data-testid": `${kind}-${k + 1}` }));
    this.elements = views.map(({ label }, k) => {
      const caption = views.length > 1 ? `${name}, ${texts.get(`view_${k + 1}`)} (${label})` : name;
      return h("figure", { class: `window ${kind}` }, h("figcaption", {}, caption), this.drawings[k]);
    });
  }

  /** Fit the view box, whose unit is the width of a line, to the size of a drawing; return half of the smaller side. */
  protected fit(drawing: SVGElement): number {
    const half = Math.min(HALF_SIDES[this.kind], Math.min(drawing.clientWidth, drawing.clientHeight) / 2 / LINE_WIDTH_PX);
    const box = `${-half} ${-half} ${2 * half} ${2 * half}`;
    // A view box that is set again costs a layout, even if it is the same.
    if (drawing.getAttribute("viewBox") !== box) drawing.setAttribute("viewBox", box);
    return half;
  }
}

export class VelocityWindows extends Windows {
  private readonly deflection = new Float64Array(this.station.arm.axes);
  private readonly command = new Float64Array(this.station.arm.axes);

  constructor(station: Drawn) {
    super(station, "velocity");
  }

  /** Let the device use the windows as its surfaces, if it needs any. */
  attach(station: Station): void {
    this.drawings.forEach((drawing, k) => station.device?.attach?.(drawing, station.experiment.views[k]));
  }

  /** Draw the velocity that a device commands now; without one, a command of zero. */
  drawCommand(stick: Stick, device: Device | null): void {
    this.deflection.fill(0);
    device?.read(this.deflection);
    stick.velocity(this.deflection, this.command);
    this.draw(this.command);
  }

  /** Draw a commanded velocity, m/cycle, with its limit and its dead zone. */
  draw(velocity: ArrayLike<number>): void {
    const { views, stick } = this.station.experiment;
    views.forEach((view, k) => {
      const reach = REACH_FRACTION * this.fit(this.drawings[k]);
      const [right, up] = projectTask(view, velocity).map((v) => (v / stick.limit) * reach);
      this.drawings[k].replaceChildren(
        circle("limit", [0, 0], reach),
        createSvg("path", { class: "axes", d: `M${-reach} 0H${reach}M0 ${-reach}V${reach}` }),
        circle("dead-zone", [0, 0], (stick.dead_zone / stick.limit) * reach),
        createSvg("line", { class: "command", x2: right, y2: -up }),
        circle("command-end", [right, -up], 3.4),
      );
    });
  }
}

export class ArmWindows extends Windows {
  private readonly points = new Float64Array(3 * this.station.arm.markers);
  private readonly start = new Float64Array(this.station.arm.axes);
  private readonly visible = enclosePoses(this.station);

  constructor(station: Drawn) {
    super(station, "arm");
  }

  /** Draw the arm at joint angles `q` with the start and the target of a task, and the path from the tool to the target. */
  draw(q: ArrayLike<number>, { q0, target }: Pose): void {
    const { arm, experiment } = this.station;
    const { middles, extent } = this.visible;
    arm.points(Float64Array.from(q), this.points);
    arm.position(Float64Array.from(q0), this.start);
    experiment.views.forEach((view, k) => {
      const scale = this.fit(this.drawings[k]) / BORDER_FACTOR / extent;
      const [middleX, middleY] = middles[k];
      const place = ([x, y]: Point): Point => [(x - middleX) * scale, (middleY - y) * scale];
      const chain = Array.from({ length: arm.markers }, (_, i) => place(projectPoint(view, this.points, 3 * i)));
      const [base, tool] = [chain[0], chain[chain.length - 1]];
      const [[startX, startY], goal] = [this.start, target].map((row) => place(projectTask(view, row)));
      this.drawings[k].replaceChildren(
        ...(experiment.reach === null ? [] : [circle("boundary", [0, 0], experiment.reach * scale)]),
        createSvg("path", { class: "start", d: `M${startX - 3.5} ${startY - 3.5}l7 7m0-7l-7 7` }),
        createSvg("line", { class: "way", x1: tool[0], y1: tool[1], x2: goal[0], y2: goal[1] }),
        circle("target", goal, experiment.radius * scale),
        createSvg("polyline", { class: "links", points: chain.join(" ") }),
        createSvg("rect", { class: "base", x: base[0] - 4, y: base[1] - 4, width: 8, height: 8 }),
        ...chain.slice(1, -1).map((joint) => circle("joint", joint, 2.6)),
        circle("tool-point", tool, 3),
      );
    });
  }
}

function circle(name: string, [cx, cy]: Point, r: number): SVGElement {
  return createSvg("circle", { class: name, cx, cy, r });
}

/**
 * Find the middle of each view and half of the visible extent, m, which are the same in all trials: the workspace, or, if its
 * boundary is unknown, all arms at the start of the session's tasks and all targets, with a margin.
 */
export function enclosePoses({ experiment, arm, plan }: Drawn): { middles: Point[]; extent: number } {
  const { reach, centre, views } = experiment;
  if (reach !== null) return { middles: views.map((view) => projectTask(view, centre)), extent: reach };
  const ranges = views.map((view) => {
    const places = [...plan.training, ...plan.trials].flatMap(({ q0, target }) => {
      const points = new Float64Array(3 * arm.markers);
      arm.points(Float64Array.from(q0), points);
      return [projectTask(view, target), ...Array.from({ length: arm.markers }, (_, i) => projectPoint(view, points, 3 * i))];
    });
    return [0, 1].map((axis) => {
      const values = places.map((place) => place[axis]);
      return { low: Math.min(...values), high: Math.max(...values) };
    });
  });
  return {
    middles: ranges.map(([x, y]) => [(x.low + x.high) / 2, (y.low + y.high) / 2]),
    extent: MARGIN_FACTOR * Math.max(...ranges.flat().map(({ low, high }) => (high - low) / 2)),
  };
}
