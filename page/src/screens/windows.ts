/** The two windows of Fig. 1, one pair for each view. */

import { ArmWindow, type ArmScene } from "../draw/arm_window";
import { point, task } from "../draw/projection";
import { VelocityWindow } from "../draw/velocity_window";
import { h } from "../dom";
import type { Station } from "../station";

/** Around what the arms need at the start of the tasks. */
const ROOM = 1.1;

/** What the windows need to know: they are drawn for the experimenter too. */
export type Drawn = Pick<Station, "experiment" | "texts" | "arm"> & { plan: { training: Posed[]; trials: Posed[] } };

interface Posed {
  q0: number[];
  target: number[];
}

function titled(title: string, content: HTMLElement, kind: string): HTMLElement {
  return h("figure", { class: `window ${kind}` }, h("figcaption", {}, title), content);
}

/** "Your command", or "Your command, from above" where there are several views. */
function caption(station: Drawn, key: string, view: number): string {
  const { texts, experiment } = station;
  const name = texts.get(key);
  return experiment.views.length > 1 ? `${name}, ${texts.get(`view_${view + 1}`)} (${experiment.views[view].label})` : name;
}

export class VelocityWindows {
  readonly elements: HTMLElement[];
  private readonly windows: VelocityWindow[];

  constructor(station: Drawn) {
    const { experiment, texts } = station;
    const { limit, dead_zone } = experiment.stick;
    const name = texts.get("velocity_window_says");
    this.windows = experiment.views.map((view, k) => new VelocityWindow(`velocity-${k + 1}`, name, view, limit, dead_zone));
    this.elements = this.windows.map((w, k) =>
      titled(caption(station, "velocity_window", k), w.surface.element, "velocity"),
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

  constructor(private readonly station: Drawn) {
    const { experiment, texts, arm } = station;
    this.points = new Float64Array(3 * arm.markers);
    const { centres, extent } = seen(station);
    const says = texts.get("arm_window_says");
    this.windows = experiment.views.map(
      (view, k) => new ArmWindow(`arm-${k + 1}`, says, view, experiment.reach, centres[k], extent),
    );
    this.elements = this.windows.map((w, k) => titled(caption(station, "arm_window", k), w.surface.element, "arm"));
  }

  draw(q: Float64Array, scene: Omit<ArmScene, "points" | "radius">): void {
    this.station.arm.points(q, this.points);
    for (const w of this.windows) w.draw({ ...scene, points: this.points, radius: this.station.experiment.radius });
  }
}

/**
 * What the windows show, the same in all trials: the workspace, or, where its boundary is not known, all arms and targets of
 * the session with some room around them.
 *
 * @returns the middle of each view, and half of what is to be seen, m
 */
function seen(station: Drawn): { centres: [number, number][]; extent: number } {
  const { experiment, arm, plan } = station;
  if (experiment.reach !== null) return { centres: experiment.views.map((v) => task(v, experiment.centre)), extent: experiment.reach };
  const points = new Float64Array(3 * arm.markers);
  const low = experiment.views.map(() => [Infinity, Infinity]);
  const high = experiment.views.map(() => [-Infinity, -Infinity]);
  for (const { q0, target } of [...plan.training, ...plan.trials]) {
    arm.points(Float64Array.from(q0), points);
    experiment.views.forEach((view, k) => {
      const all = [task(view, target), ...Array.from({ length: arm.markers }, (_, i) => point(view, points, 3 * i))];
      for (const place of all) {
        place.forEach((value, i) => {
          low[k][i] = Math.min(low[k][i], value);
          high[k][i] = Math.max(high[k][i], value);
        });
      }
    });
  }
  const centres = low.map((l, k) => l.map((v, i) => (v + high[k][i]) / 2) as [number, number]);
  const extent = ROOM * Math.max(...low.flatMap((l, k) => l.map((v, i) => (high[k][i] - v) / 2)));
  return { centres, extent };
}
