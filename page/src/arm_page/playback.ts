/** Motions over time, as further arms with trails of the tool. */

import { createSvg, h } from "../dom";
import { Player } from "../player";
import { between } from "../viewer/algebra";
import type { OverlayContent, Trail } from "../viewer/overlay";
import type { Vector } from "../viewer/scene";
import type { ArmPage } from "./arm_page";

const LONGEST_PLAY_S = 6;

export interface PlayedMotion {
  label: string;
  /** What the label says in bold. */
  note?: string;
  /** Unit of the time: s, or cycles. */
  unit?: string;
  time: number[];
  /** Configurations (T x n), rad and m. */
  q: ArrayLike<number>[];
}

/** An entry of a legend: a shape of 34 x 10, and its meaning. */
export function createKey(shape: SVGElement, ...meaning: (Node | string)[]): HTMLElement {
  const svg = createSvg("svg", { viewBox: "0 0 34 10", "aria-hidden": "true" });
  svg.append(shape);
  return h("span", { class: "law-key" }, svg, ...meaning);
}

export class Playback {
  readonly player: Player;
  readonly element: HTMLElement;
  motions: PlayedMotion[] = [];
  /** Configuration of each motion at the shown time, rad and m. */
  configurations: number[][] = [];
  private trails: Vector[][] = [];
  private readonly legend = h("div");

  /** `show` is called after a change of the shown time. */
  constructor(
    private readonly page: ArmPage,
    private readonly styles: readonly Trail["style"][],
    private readonly show: () => void,
  ) {
    const format = (time: number): string => `${time.toFixed(this.end < 20 ? 1 : 0)} ${this.motions[0].unit ?? "s"}`;
    this.player = new Player(page.data.texts, format, () => this.showTime());
    const { button, input, readout } = this.player;
    this.element = h("div", { hidden: true }, this.legend, h("label", {}, button, input, readout));
  }

  /** Show motions at a time, or play them from the beginning; with reduced motion, show their end. */
  open(motions: PlayedMotion[], time?: number): void {
    this.motions = motions;
    this.trails = motions.map((motion) => motion.q.map((q) => this.page.arm.toolPosition(q)));
    const keys = motions.map(({ label, note = "" }, k) => {
      const line = createSvg("path", { class: `overlay-trail overlay-${this.styles[k]}`, d: "M1 5H33" });
      return h("div", { class: "step-row" }, createKey(line, label, h("span", {}, note)));
    });
    this.legend.replaceChildren(...keys);
    this.element.hidden = false;
    this.player.setRange(this.end, Math.max(1, this.end / LONGEST_PLAY_S));
    this.player.showTime(time || this.end);
    if (!time && !this.page.reducedMotion) this.player.play();
  }

  close(): void {
    this.player.stop();
    [this.motions, this.configurations] = [[], []];
    this.element.hidden = true;
  }

  get overlay(): OverlayContent {
    const trails = this.motions.map((motion, k) => ({
      points: this.trails[k].slice(0, Math.ceil(this.sample(motion)) + 1),
      style: this.styles[k],
    }));
    return { trails: trails.filter(({ points }) => points.length > 1) };
  }

  private get end(): number {
    return Math.max(...this.motions.map(({ time }) => time[time.length - 1]));
  }

  private showTime(): void {
    this.configurations = this.motions.map((motion) => between(motion.q, this.sample(motion)));
    this.show();
  }

  /** Index of the shown sample, with its fraction. */
  private sample({ time }: PlayedMotion): number {
    const after = time.findIndex((value) => value > this.player.time);
    if (after <= 0) return after < 0 ? time.length - 1 : 0;
    return after - 1 + (this.player.time - time[after - 1]) / (time[after] - time[after - 1]);
  }
}
