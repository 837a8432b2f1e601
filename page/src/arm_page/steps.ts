/** The five steps of the story. Each one sets the joints, shows its controls, and adds to the picture. */

import { createMenu, createSvg, h } from "../dom";
import type { OverlayContent } from "../viewer/overlay";
import type { Vector } from "../viewer/scene";
import { listJoints } from "./address";
import type { ArmPage } from "./arm_page";
import { simulateControl } from "./closed_loop";
import { drawCurve } from "./curves";
import { lostMotions, toolEllipsoid, type LostMotion } from "./failures";
import type { GhostColor } from "./page_view";
import { capitalise, fillText, formatAngle, formatLength, formatPercent } from "./phrases";
import { createKey, Playback } from "./playback";
import { simulateFall, swingJoint, type Fall, type Swing } from "./power_loss";
import { traceSelfMotion, type SelfMotion } from "./self_motion";

const MAX_BRAKE_DELAY_MS = 500;
const BRAKE_DELAY_STEP_MS = 10;
const SLIDE_SPEED_SAMPLES_PER_PICTURE = 2; // on the way to the best configuration
const PAUSE_RATIO = 25;
const STRUCTURAL_ZERO = 1e-6; // relative manipulability below which a joint has no substitute
const TRAIL_STYLES = ["solid", "dotted", "dashed"] as const;

export abstract class Step<Page extends ArmPage = ArmPage> {
  /** Configurations that the picture shows transparently. */
  ghosts: ArrayLike<number>[] = [];
  ghostColors: GhostColor[] = [];
  /** Motions that the step shows, if it has some. */
  readonly playback: Playback | null = null;

  constructor(protected readonly page: Page) {}

  /** Set the joints and write the controls, after the visitor has chosen the step. */
  abstract enter(): void;
  /** Compute what belongs to a new configuration or condition. */
  update(): void {}
  /** Return the headline and its detail. */
  abstract sentences(): [string, string];

  /** End of the last long computation, and its duration, ms. */
  private computed = { end: -Infinity, duration: 0 };

  /** Compute at once, or, during a drag, only after a pause of 25 times the last duration, so that pictures stay in time. */
  protected computeWhenDue(compute: () => void): void {
    const start = performance.now();
    if (this.page.dragging && start - this.computed.end < PAUSE_RATIO * this.computed.duration) return;
    compute();
    const end = performance.now();
    this.computed = { end, duration: end - start };
  }

  /** Compute what takes longer than a picture, after a drag. */
  rest(): void {}
  /** Stop animations, before another step. */
  leave(): void {
    this.playback?.close();
  }

  /** Configuration that the picture shows. */
  get configuration(): ArrayLike<number> {
    return this.page.state.q;
  }

  overlay(): OverlayContent {
    return this.playback?.overlay ?? {};
  }

  protected text(key: string, values: Record<string, string | number> = {}): string {
    return fillText(this.page.data.texts[key], values);
  }

  protected button(key: string, action: () => void): HTMLButtonElement {
    return h("button", { type: "button", onclick: action }, this.text(key));
  }

  protected row(...children: (Node | null)[]): HTMLElement {
    return h("div", { class: "step-row" }, ...children);
  }

  protected slider(key: string, max: number, step: number, value: number, input: (value: number) => void): HTMLInputElement {
    const slider = h("input", { type: "range", min: 0, max, step, value, "aria-label": this.text(key) });
    slider.addEventListener("input", () => input(Number(slider.value)));
    return slider;
  }
}

export class HealthyStep extends Step {
  enter(): void {
    this.page.repairAll();
  }

  sentences(): [string, string] {
    const { fractions, worst, touched } = this.page;
    if (!touched) return [this.text("healthy_before"), this.text("healthy_detail")];
    const values = { joint: this.page.data.jointLabels[worst], share: formatPercent(fractions[worst]) };
    return [this.text("healthy", values), this.text("healthy_detail")];
  }
}

export class LockStep extends Step {
  private lost: LostMotion[] = [];

  enter(): void {
    if (this.page.failed.length === 0) this.page.setCondition(this.page.worst, "locked");
    const key = (style: string): HTMLElement => {
      const shape = createSvg("ellipse", { class: `overlay-ellipsoid overlay-${style}`, cx: 17, cy: 5, rx: 15, ry: 4 });
      return createKey(shape, this.text(`${style}_lock`));
    };
    this.page.controls.replaceChildren(
      this.row(key("before"), key("after")),
      this.row(this.button("unlock_all", () => this.page.changeConditions(() => this.page.repairAll()))),
    );
  }

  override update(): void {
    const { arm, state, failed } = this.page;
    this.lost = failed.length ? lostMotions(arm, state.q, failed) : [];
  }

  sentences(): [string, string] {
    const { failed, state } = this.page;
    if (failed.length === 0) return [this.text("lock_none"), this.text("healthy_detail")];
    const conditions = new Set(failed.map((joint) => state.conditions[joint]));
    const verb = failed.length > 1 ? "are" : "is";
    const condition = this.text(conditions.size > 1 ? "have_failed" : `${verb}_${[...conditions][0]}`);
    const values = { joints: capitalise(this.page.failedNames()), condition, share: formatPercent(this.lost[0].remaining) };
    return [this.text("lock", values), this.text("lock_detail")];
  }

  override overlay(): OverlayContent {
    const { arm, state, failed } = this.page;
    const center = arm.toolPosition(state.q);
    if (failed.length === 0) return {};
    return {
      ellipsoids: [
        { center, ...toolEllipsoid(arm, state.q, []), style: "before" },
        { center, ...toolEllipsoid(arm, state.q, failed), style: "after" },
      ],
      lost: this.lost
        .filter((motion) => motion.remaining < 0.99)
        .map((motion) => ({ center, twist: [...motion.twist], words: formatPercent(motion.remaining) })),
    };
  }
}

export class PrepareStep extends Step {
  private motion: SelfMotion | null = null;
  private index = 0;
  private timer = 0;
  private input = this.slider("self_motion", 0, 1, 0, (index) => this.slide(index));
  private curve = h("div");
  /** Direction of the self-motion; null for the one in which the worst case rises. */
  private direction: number | null = null;

  enter(): void {
    if (!this.page.hasSelfMotion) this.page.repairAll();
    [this.motion, this.direction] = [null, null];
    const best = this.button("go_to_best", () => this.goToBest());
    const directions = this.page.arm.redundancy - this.page.failed.length;
    const names = [this.text("steepest"), ...Array.from({ length: directions }, (_, k) => String(k + 1))];
    const menu = createMenu(this.text("direction"), names, 0, (index) => {
      this.direction = index ? index - 1 : null;
      this.motion = null;
      this.page.changeConditions(() => undefined);
    });
    this.page.controls.replaceChildren(this.curve, this.input, this.row(best, directions > 1 ? menu : null));
  }

  override update(): void {
    const { arm, state, failed } = this.page;
    if (this.motion?.configurations[this.index] === state.q) return this.showMotion(this.motion);
    this.computeWhenDue(() => {
      this.motion = traceSelfMotion(arm, state.q, failed, this.direction);
      this.index = this.motion.start;
      this.input.max = String(this.motion.configurations.length - 1);
      this.showMotion(this.motion);
    });
  }

  private showMotion({ worst, best }: SelfMotion): void {
    this.input.value = String(this.index);
    this.input.disabled = worst.length < 2;
    this.input.setAttribute("aria-valuetext", this.sentences()[0]);
    const bound = this.page.data.bound;
    const yMax = Math.max(...worst, bound);
    this.curve.replaceChildren(
      drawCurve({
        x: worst.map((_, k) => k),
        y: worst,
        yMax,
        format: formatPercent,
        xLabel: this.text("self_motion"),
        xEnds: ["", ""],
        yLabel: this.text("curve_worst"),
        marker: this.index,
        limit: bound ? { y: bound, label: this.text("curve_bound") } : undefined,
        alternative: this.text("curve_worst_alternative", {
          first: formatPercent(worst[0]),
          last: formatPercent(worst[worst.length - 1]),
          best: formatPercent(worst[best]),
        }),
      }),
    );
  }

  override leave(): void {
    cancelAnimationFrame(this.timer);
  }

  sentences(): [string, string] {
    const { data, fractions, worst, arm } = this.page;
    if (this.motion === null || this.motion.worst[this.motion.best] < STRUCTURAL_ZERO) {
      return [this.text("fixed"), this.text("fixed_detail", { joint: this.page.data.jointLabels[worst] })];
    }
    const best = formatPercent(this.motion.worst[this.motion.best]);
    return [
      this.text("prepare", { share: formatPercent(fractions[worst]) }),
      this.text("prepare_detail", { best, count: arm.jointCount, bound: formatPercent(data.bound) }),
    ];
  }

  private slide(index: number): void {
    this.index = index;
    this.page.setConfiguration((this.motion as SelfMotion).configurations[index]);
  }

  private goToBest(): void {
    cancelAnimationFrame(this.timer);
    const { best } = this.motion as SelfMotion;
    const distance = best - this.index;
    const steps = this.page.reducedMotion ? Math.abs(distance) : SLIDE_SPEED_SAMPLES_PER_PICTURE;
    this.slide(this.index + Math.sign(distance) * Math.min(Math.abs(distance), steps));
    if (this.index !== best) this.timer = requestAnimationFrame(() => this.goToBest());
  }
}

export class UndetectedStep extends Step {
  override readonly playback = new Playback(this.page, TRAIL_STYLES, () => {
    this.ghosts = this.playback.configurations.slice(1);
    this.page.draw();
  });
  private line: [Vector, Vector] | null = null;

  enter(): void {
    if (this.page.failed.length !== 1) {
      this.page.repairAll();
      this.page.setCondition(this.page.worst, "locked");
    }
    this.page.controls.replaceChildren(this.playback.element);
    this.rest();
  }

  /** Simulate the motions from the present configuration, and play them. */
  override rest(): void {
    const { arm, state, failed, data, controlTarget } = this.page;
    const { story } = data;
    if (story === null || this.playback.player.playing) return;
    const { configurations, best } = traceSelfMotion(arm, state.q);
    this.line = [arm.toolPosition(state.q), controlTarget];
    const { laws: [first, second], gain, speed } = story;
    const runs = [
      { label: first.name, law: first.slug, start: state.q },
      { label: second.name, law: second.slug, start: state.q },
      { label: this.text("prepared_law", { law: first.name }), law: first.slug, start: configurations[best] },
    ];
    const motions = runs.map(({ label, law, start }) => {
      const motion = simulateControl(arm, start, controlTarget, failed, { law, gain, speed });
      return { ...motion, label, note: this.text("deviation", { deviation: formatLength(motion.deviation) }) };
    });
    this.playback.open(motions);
  }

  override get configuration(): ArrayLike<number> {
    return this.playback.configurations[0] ?? this.page.state.q;
  }

  sentences(): [string, string] {
    const story = this.page.data.story;
    if (!story) return ["", ""];
    const [first, second, prepared] = story.deviations.map(formatLength);
    const key = story.motions ? "undetected_detail" : "undetected_given";
    const detail = this.text(key, { count: story.motions, first, second, prepared });
    return [this.text("undetected", { joint: capitalise(this.page.failedNames()) }), detail];
  }

  override overlay(): OverlayContent {
    return { ...super.overlay(), pointerLine: this.line ?? undefined };
  }
}

export class PowerStep<Page extends ArmPage = ArmPage> extends Step<Page> {
  private fall: Fall | null = null;
  private swing: Swing | null = null;
  private input = this.slider("brake_delay", MAX_BRAKE_DELAY_MS, BRAKE_DELAY_STEP_MS, 0, (delay) => this.setDelay(delay));
  private readout = h("output");
  private joints = h("label");
  private curve = h("div");

  enter(): void {
    this.page.repairAll();
    this.joints = createMenu(this.text("torque_lost"), [this.text("all_joints"), ...this.page.data.jointLabels], 0, (index) => {
      this.page.changeConditions(() => {
        this.page.repairAll();
        if (index > 0) this.page.setCondition(index - 1, "free");
      });
    });
    this.page.controls.replaceChildren(
      this.curve,
      h("label", {}, h("span", {}, this.text("brake_delay")), this.input, this.readout),
      this.joints,
    );
  }

  override update(): void {
    const { arm, state, data } = this.page;
    const free = listJoints(state.conditions, "free");
    (this.joints.control as HTMLSelectElement).selectedIndex = free.length === 1 ? free[0] + 1 : 0;
    const falling = state.conditions.map((condition): number =>
      Number(free.length ? condition === "free" : condition === "healthy"));
    this.computeWhenDue(() => {
      this.fall = simulateFall(arm, state.q, falling, MAX_BRAKE_DELAY_MS / 1000, data.gravity);
      this.swing = free.length === 1 ? swingJoint(arm, state.q, free[0]) : null;
      this.showDelay();
    });
  }

  sentences(): [string, string] {
    const { state } = this.page;
    const drop = formatLength(this.drop);
    if (this.swing !== null) {
      const joint = capitalise(this.page.failedNames());
      const angle = formatAngle(Math.abs(this.swing.toFarthest));
      return [this.text("swing", { joint, angle }), this.text("swing_detail", { delay: state.brakeDelay, drop })];
    }
    const { limitJoint, time } = this.fall as Fall;
    const end = time[time.length - 1];
    const detail = limitJoint === null || state.brakeDelay / 1000 < end ? this.text("power_detail")
      : this.text("power_limit", { joint: capitalise(this.page.data.jointLabels[limitJoint]), delay: (1000 * end).toFixed(0) });
    return [this.text("power", { delay: state.brakeDelay, drop }), detail];
  }

  private get sample(): number {
    const { time } = this.fall as Fall;
    const delay = this.page.state.brakeDelay / 1000;
    return time.reduce((best, t, k) => (Math.abs(t - delay) < Math.abs(time[best] - delay) ? k : best), 0);
  }

  private get drop(): number {
    return (this.fall as Fall).drop[this.sample];
  }

  private setDelay(delay: number): void {
    this.page.state.brakeDelay = delay;
    this.showDelay();
    this.page.draw();
  }

  private showDelay(): void {
    const { time, drop, configurations } = this.fall as Fall;
    const delay = this.page.state.brakeDelay;
    this.ghosts = [configurations[this.sample]];
    this.input.max = String(Math.floor((1000 * time[time.length - 1]) / BRAKE_DELAY_STEP_MS) * BRAKE_DELAY_STEP_MS);
    this.input.value = String(delay);
    this.readout.textContent = `${this.input.value} ms`;
    this.input.setAttribute("aria-valuetext", `${delay} ms: ${formatLength(this.drop)}`);
    const height = Math.max(...drop.map(Math.abs), 0.01);
    this.curve.replaceChildren(
      drawCurve({
        x: time,
        y: drop,
        yMax: height,
        format: formatLength,
        xLabel: this.text("brake_delay"),
        xEnds: ["0", `${(1000 * time[time.length - 1]).toFixed(0)} ms`],
        yLabel: this.text("curve_drop"),
        marker: this.sample,
        alternative: this.text("curve_drop_alternative", {
          last: formatLength(drop[drop.length - 1]),
          delay: (1000 * time[time.length - 1]).toFixed(0),
        }),
      }),
    );
  }
}

export type StepClasses = Record<string, new (page: ArmPage) => Step>;
export const STEP_CLASSES: StepClasses = {
  healthy: HealthyStep,
  lock: LockStep,
  prepare: PrepareStep,
  undetected: UndetectedStep,
  power: PowerStep,
};
