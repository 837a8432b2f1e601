/** One trial: wait for the trigger, steer, stop inside the circle. Broken off trials are done again at once. */

import { button, h, setText } from "../dom";
import { Run, type Ending, type Task } from "../run";
import { Frames, type Schedule } from "../schedule";
import type { Station } from "../station";
import { ArmWindows, VelocityWindows } from "./windows";

export interface TrialSpec {
  title: string;
  task: Task;
  /** What it is called in the records; null for practice, which is not recorded and shows hints. */
  record: { kind: "training" | "trial"; position: number } | null;
  /** Shown until it begins: how the last one went. */
  note: string;
}

export interface Outcome {
  end: Ending;
  cycles: number;
}

type Phase = "waiting" | "running" | "broken" | "over";

/** How long the end is shown, s. */
const SHOWN = 0.7;

export function performTrial(element: HTMLElement, station: Station, spec: TrialSpec): Promise<Outcome> {
  return new Promise((resolve) => new Trial(element, station, spec, resolve).prepare());
}

class Trial {
  private phase: Phase = "waiting";
  private run: Run;
  private frames = new Frames();
  private aborting = false;
  /** When the last cycle began, s after the first. */
  private cycleAt = 0;
  private lost = false;
  private readonly arms: ArmWindows;
  private readonly velocities: VelocityWindows;
  private readonly deflection: Float64Array;
  private readonly controller = new AbortController();
  private readonly message = h("p", { class: "message", "aria-live": "polite", "data-testid": "message" });
  private readonly begin: HTMLButtonElement;
  private readonly abort: HTMLButtonElement;
  private readonly root: HTMLElement;

  constructor(
    private readonly element: HTMLElement,
    private readonly station: Station,
    private readonly spec: TrialSpec,
    private readonly resolve: (outcome: Outcome) => void,
  ) {
    const { texts, arm } = station;
    this.deflection = new Float64Array(arm.axes);
    this.run = this.fresh();
    this.arms = new ArmWindows(station);
    this.velocities = new VelocityWindows(station);
    this.begin = button("start", texts.get("start"), () => this.begun());
    this.abort = button("abort", texts.get("abort"), () => (this.aborting = true), "second");
    const arms = h("div", { class: "arms" }, ...this.arms.elements);
    const buttons = h("div", { class: "buttons" }, this.begin, this.abort);
    const side = h("div", { class: "side" }, ...this.velocities.elements, this.message, buttons);
    const views = station.experiment.views.length;
    this.root = h("section", { class: "trial", "data-testid": "trial", "data-views": views }, arms, side);
  }

  prepare(): void {
    const { signal } = this.controller;
    window.addEventListener("keydown", (event) => this.key(event), { signal });
    document.addEventListener("visibilitychange", () => document.hidden && this.breakOff("hidden"), { signal });
    this.element.replaceChildren(this.root);
    this.station.frame.progress(this.spec.title);
    this.velocities.attach(this.station);
    this.wait();
    const draw = (): void => {
      if (this.phase === "over") return;
      this.draw();
      requestAnimationFrame(draw);
    };
    requestAnimationFrame(draw);
  }

  private fresh(): Run {
    const { arm, stick, experiment } = this.station;
    return new Run(arm, this.spec.task, stick, experiment);
  }

  private enter(phase: Phase, text: string): void {
    this.phase = phase;
    this.root.dataset.phase = phase;
    this.message.textContent = text;
    this.begin.disabled = phase === "running" || phase === "over";
    this.abort.disabled = phase !== "running";
    this.station.frame.set({ occupied: phase === "running" || phase === "over" });
  }

  private get howToStart(): string {
    return this.station.texts.get(`start_${this.station.device?.kind ?? "keys"}`);
  }

  private wait(): void {
    this.run = this.fresh();
    this.aborting = false;
    this.station.device?.begin?.();
    this.enter("waiting", [this.spec.note, this.howToStart].join("\n").trim());
    this.begin.textContent = this.station.texts.get("start");
  }

  private key(event: KeyboardEvent): void {
    if (event.key === "Escape" && this.phase === "running") {
      event.preventDefault();
      this.aborting = true;
    } else if (event.key === " " && !event.repeat && this.phase !== "running" && event.target !== this.begin) {
      event.preventDefault();
      this.begun();
    }
  }

  private begun(): void {
    const { station, spec } = this;
    if (this.phase === "broken") return this.wait();
    if (this.phase !== "waiting" || station.frame.isCovered || station.device?.lost?.() || document.hidden) return;
    if (spec.record !== null) station.send({ type: "begin", ...spec.record });
    this.frames = new Frames();
    this.enter("running", station.texts.get("trial_running"));
    station.clock.start(station.experiment.rate, (time) => this.cycle(time));
  }

  private cycle(time: number): void {
    const { station, run, spec } = this;
    if (station.device?.lost?.()) return this.breakOff("pad-lost");
    if (station.frame.isUnstored) return this.breakOff("unstored");
    station.device?.see?.({ cycle: run.cycles, x: run.x, target: spec.task.target });
    station.device?.read(this.deflection);
    const end = run.step(this.deflection, this.aborting || station.device?.tired === true);
    if (end !== null) return this.finish(end);
    this.cycleAt = time;
    if (spec.record === null) return;
    station.send({
      type: "cycles",
      first: run.cycles - 1,
      time: [time],
      velocity: [Array.from(run.velocity)],
      q: [Array.from(run.before)],
    });
  }

  private finish(end: Ending): void {
    const { station, run } = this;
    this.report(station.clock.stop());
    this.ended(end);
    this.enter("over", station.texts.get(`trial_${end}`));
    this.controller.abort();
    this.draw();
    setTimeout(() => {
      station.device?.detach?.();
      this.resolve({ end, cycles: run.cycles });
    }, SHOWN * 1000);
  }

  /** It does not count: the person could not see, or not steer. */
  private breakOff(why: "hidden" | "pad-lost" | "unstored"): void {
    if (this.phase !== "running") return;
    const { station } = this;
    this.report(station.clock.stop());
    station.event(why, { cycles: this.run.cycles });
    this.ended("broken-off");
    this.enter("broken", station.texts.get(`broken_${why}`));
    this.begin.textContent = station.texts.get("again");
    station.auto(() => this.begun());
  }

  private ended(end: Ending): void {
    if (this.spec.record !== null) this.station.send({ type: "end", end, q: Array.from(this.run.q) });
  }

  /** Cycles that were missed or late, and frames that the display left out. */
  private report(clock: Schedule | null): void {
    const frames = this.frames.summary();
    if (clock === null || this.spec.record === null || (!clock.missed && !clock.late && !frames.slow)) return;
    this.station.event("dropped-frames", {
      missed_cycles: clock.missed,
      late_cycles: clock.late,
      worst_cycle_s: rounded(clock.worst),
      frames: frames.frames,
      slow_frames: frames.slow,
      usual_frame_s: rounded(frames.usual),
      worst_frame_s: rounded(frames.worst),
    });
  }

  private draw(): void {
    const { station, run, spec, phase } = this;
    if (phase === "waiting" || phase === "broken") this.watch();
    if (phase === "running") this.frames.at(performance.now() / 1000);
    // The arm moves from one configuration to the next during the cycle whose command was read at its beginning.
    const share = phase === "running" ? (station.clock.now - this.cycleAt) * station.experiment.rate : 1;
    const part = Math.max(0, Math.min(1, share));
    this.arms.draw(run.before.map((before, i) => before + part * (run.q[i] - before)), spec.task);
    this.velocities.drawCommand(station.stick, phase === "broken" || phase === "over" ? null : station.device);
    if (phase === "running" && spec.record === null) {
      setText(this.message, station.texts.get(run.inside ? "hint_inside" : "trial_running"));
    }
  }

  private watch(): void {
    const { station } = this;
    const lost = station.device?.lost?.() === true;
    if (lost !== this.lost && this.phase === "waiting") {
      this.lost = lost;
      if (lost) station.event("pad-lost");
      this.message.textContent = lost ? station.texts.get("broken_pad-lost") : this.howToStart;
    }
    if (station.device?.triggered?.()) this.begun();
  }
}

function rounded(seconds: number): number {
  return Math.round(seconds * 1e5) / 1e5;
}
