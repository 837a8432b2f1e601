/** The two windows of Fig. 1, one pair for each view. */

import { ArmWindow, type ArmScene } from "../draw/arm_window";
import { VelocityWindow } from "../draw/velocity_window";
import { h } from "../dom";
import type { Station } from "../station";

/** What the windows need to know: they are drawn for the experimenter too. */
export type Drawn = Pick<Station, "study" | "texts" | "arm">;

function titled(title: string, content: HTMLElement, kind: string): HTMLElement {
  return h("figure", { class: `window ${kind}` }, h("figcaption", {}, title), content);
}

/** "Your command", or "Your command: x, y" where there are several views. */
function caption(station: Drawn, key: string, label: string): string {
  const name = station.texts.get(key);
  return station.study.views.length > 1 ? `${name}: ${label}` : name;
}

export class VelocityWindows {
  readonly elements: HTMLElement[];
  private readonly windows: VelocityWindow[];

  constructor(station: Drawn) {
    const { study, texts } = station;
    const { limit, dead_zone } = study.stick;
    const name = texts.get("velocity_window_says");
    this.windows = study.views.map((view, k) => new VelocityWindow(`velocity-${k + 1}`, name, view, limit, dead_zone));
    this.elements = this.windows.map((w) =>
      titled(caption(station, "velocity_window", w.view.label), w.surface.element, "velocity"),
    );
  }

  /** Let the device use the windows as its surfaces, if it needs any. */
  attach(station: Station): void {
    for (const w of this.windows) station.device?.attach?.(w.surface.element, w.view, w.reach);
  }

  draw(velocity: ArrayLike<number>): void {
    for (const w of this.windows) w.draw(velocity);
  }
}

export class ArmWindows {
  readonly elements: HTMLElement[];
  private readonly windows: ArmWindow[];
  private readonly points: Float64Array;

  constructor(
    private readonly station: Drawn,
    extent: number,
  ) {
    const { study, texts, arm } = station;
    this.points = new Float64Array(3 * arm.markers);
    this.windows = study.views.map(
      (view, k) => new ArmWindow(`arm-${k + 1}`, texts.get("arm_window_says"), view, study.reach, study.centre, extent),
    );
    this.elements = this.windows.map((w, k) =>
      titled(caption(station, "arm_window", study.views[k].label), w.surface.element, "arm"),
    );
  }

  draw(q: Float64Array, scene: Omit<ArmScene, "points" | "radius">): void {
    this.station.arm.points(q, this.points);
    for (const w of this.windows) w.draw({ ...scene, points: this.points, radius: this.station.study.radius });
  }
}

/** Half of what must be seen, m: the workspace, or the arm stretched out where its boundary is not known. */
export function extent(station: Drawn, q: Float64Array): number {
  const { study, arm } = station;
  if (study.reach !== null) return study.reach;
  const points = new Float64Array(3 * arm.markers);
  arm.points(q, points);
  let length = 0;
  for (let k = 3; k < points.length; k += 3) {
    length += Math.hypot(points[k] - points[k - 3], points[k + 1] - points[k - 2], points[k + 2] - points[k - 1]);
  }
  return length;
}
