/** The two windows that the subject sees, updated live. */

import type { Arm } from "../arm";
import { h } from "../dom";
import { ArmWindows, VelocityWindows } from "../screens/windows";
import type { Experiment } from "../experiment";
import { Texts } from "../texts";
import type { About, Cycle } from "./server";
import { texts } from "./texts";

export class LiveView {
  readonly element: HTMLElement;
  private readonly arms: ArmWindows;
  private readonly velocities: VelocityWindows;
  private readonly what = h("p", { class: "what", "data-testid": "live-what" });
  private readonly windows: HTMLElement;

  constructor(
    private readonly experiment: Experiment,
    arm: Arm,
    private readonly about: About,
  ) {
    const drawn = { experiment, arm, texts: new Texts(texts.window), plan: about.plan };
    this.arms = new ArmWindows(drawn);
    this.velocities = new VelocityWindows(drawn);
    this.windows = h("div", { class: "windows" }, ...this.arms.elements, ...this.velocities.elements);
    this.element = h("div", { class: "live", "data-testid": "live" }, this.what, this.windows);
  }

  /** @param cycle the last that is known; null for none */
  show(cycle: Cycle | null, steering: boolean): void {
    this.element.dataset.steering = String(steering);
    this.element.dataset.cycle = cycle === null ? "" : String(cycle.cycle);
    this.windows.hidden = cycle === null;
    const said = cycle === null ? "" : this.said(cycle, steering);
    this.what.textContent = steering ? said : `${texts.still} ${said}`.trim();
    if (cycle === null) return;
    this.arms.draw(cycle.q, cycle);
    this.velocities.draw(cycle.velocity);
  }

  private said(c: Cycle, steering: boolean): string {
    const joint = c.healthy.indexOf(0);
    const locked = joint < 0 ? "" : texts.locked(this.about.joints[joint]);
    const seconds = (c.cycle / this.experiment.rate).toFixed(1);
    const said = texts.under(texts[c.kind], c.position + 1, this.about.scenarios[c.scenario], locked, seconds);
    return steering ? said[0].toUpperCase() + said.slice(1) : `${texts.last} ${said}`;
  }
}
