/** Steps of the studio after the five steps of the page; the server computes what they show. */

import { createFilePicker, h } from "../dom";
import type { Answers, Cloud, Watch } from "./answers";
import type { GhostColor } from "./page_view";
import { saveFile, savePicture } from "./picture_file";
import { Playback, type PlayedMotion } from "./playback";
import { drawSignals } from "./signals";
import { PowerStep, Step, STEP_CLASSES, type StepClasses } from "./steps";
import { formatNumber, MAX_FILE_BYTES, type StudioPage, type StudioStepParts } from "./studio_page";

type MotionColor = Extract<GhostColor, "green" | "orange" | "purple">;
const LATEST_ONSET_S = 4;

abstract class StudioStep extends Step<StudioPage> implements StudioStepParts {
  discard(): void {
    this.ghosts = [];
  }

  override leave(): void {
    this.discard();
  }
}

class ChooseStep extends StudioStep {
  private found: Answers["best-worst"] | null = null;
  private readonly takeButtons = [0, 1].map((k) => this.button(k ? "studio_take_worst" : "studio_take_best", () => this.take(k)));

  get show(): string {
    return this.found ? "best-worst" : "arm";
  }

  enter(): void {
    const { indices, susceptibilities } = this.page.data.studio;
    const objectives = [...new Set([...indices, ...susceptibilities])];
    const menu = this.page.createMenu(this.text("studio_objective"), objectives, this.page.studio.objective, (objective) => {
      this.page.studio.objective = objective;
      this.discard();
    });
    const find = this.button("studio_find", () => void this.run());
    this.page.controls.replaceChildren(menu, this.row(find), this.row(...this.takeButtons));
  }

  async run(): Promise<void> {
    const found = await this.page.run("best-worst", { show: "best-worst" });
    if (!found) return;
    this.found = found;
    [this.ghosts, this.ghostColors] = [[...found.q], ["green", "orange"]];
    for (const button of this.takeButtons) button.disabled = false;
    this.page.draw();
  }

  override discard(): void {
    super.discard();
    this.found = null;
    for (const button of this.takeButtons) button.disabled = true;
  }

  sentences(): [string, string] {
    if (!this.found) return [this.text("studio_choose"), this.text("studio_choose_detail")];
    const [best, worst, now] = this.found.values.map(formatNumber);
    return [this.text("studio_found", { best, worst }), this.text("studio_found_detail", { now })];
  }

  private take(k: number): void {
    if (this.found) this.page.setConfiguration(this.found.q[k]);
  }
}

/** A step with motions. */
abstract class MotionStep extends StudioStep {
  abstract readonly show: string;
  override readonly playback: Playback;

  constructor(page: StudioPage, colors: MotionColor[] = ["purple"]) {
    super(page);
    this.playback = new Playback(page, colors, () => {
      [this.ghosts, this.ghostColors] = [this.playback.configurations, colors];
      this.showTime();
      page.draw();
    });
  }

  /** Show what belongs to the time of the player. */
  protected showTime(): void {}

  protected open(motions: PlayedMotion[]): void {
    this.playback.open(motions, this.page.takeTime());
  }

  override discard(): void {
    super.discard();
    this.playback.close();
  }
}

class LawsStep extends MotionStep {
  readonly show = "laws";
  readonly hasTarget = true;

  constructor(page: StudioPage) {
    super(page, ["green", "orange"]);
  }

  enter(): void {
    const { laws } = this.page.data.studio;
    const menus = [0, 1].map((k) =>
      this.page.createMenu(this.text(k ? "studio_law_orange" : "studio_law_green"), laws, this.page.studio.laws[k], (law) => {
        this.page.studio.laws[k] = law;
        this.discard();
      }),
    );
    const move = this.button("studio_move", () => void this.run());
    const target = this.button("studio_target", () => void this.page.chooseTarget(true));
    this.page.controls.replaceChildren(...menus, this.row(move, target), this.playback.element);
    void this.page.chooseTarget();
  }

  async run(): Promise<void> {
    await this.page.chooseTarget();
    const motions = await this.page.run("laws", { show: "laws" });
    if (motions) this.open(motions);
  }

  sentences(): [string, string] {
    const failed = this.page.failed.length;
    const joints = this.page.failedNames();
    return [failed ? this.text("studio_laws", { joints }) : this.text("studio_laws_healthy"), this.text("studio_laws_detail")];
  }
}

class RegionStep extends StudioStep {
  private cloud: Cloud | null = null;
  private chosen = -1;
  private readonly pointSlider = this.slider("studio_point", 0, 1, 0, (index) => this.page.view.choose(index));
  private readonly caption = h("p", { class: "bars-note" });

  get show(): string {
    return this.cloud ? "region" : "arm";
  }

  enter(): void {
    const { region } = this.page.data.studio.state;
    const assess = this.button("studio_assess", () => void this.assess(null));
    const open = region === null ? null : this.button("studio_open_region", () => void this.assess(region));
    const point = h("label", {}, h("span", {}, this.text("studio_point")), this.pointSlider);
    this.page.controls.replaceChildren(this.row(assess, open), this.caption, point);
    this.showCloud();
  }

  override leave(): void {
    const { scene } = this.page.view;
    [scene.points, scene.colors] = [[], []];
    this.page.view.choose(-1);
  }

  run(): Promise<void> {
    return this.assess(this.page.data.studio.state.region);
  }

  private async assess(region: string | null): Promise<void> {
    const cloud = await this.page.run("region", { show: "region", region });
    if (!cloud) return;
    [this.cloud, this.chosen] = [cloud, -1];
    this.showCloud();
    this.page.draw();
  }

  private showCloud(): void {
    const { scene } = this.page.view;
    const { points, colors, label } = this.cloud ?? { points: [], colors: [], label: "" };
    [scene.points, scene.colors] = [points, colors];
    this.caption.textContent = label;
    this.pointSlider.max = String(points.length - 1);
    this.pointSlider.disabled = points.length === 0;
  }

  /** Go to the configuration of a point. */
  choosePoint(index: number): void {
    const q = this.cloud?.q[index];
    if (index < 0 || q === undefined) return;
    this.chosen = index;
    this.pointSlider.value = String(index);
    if (q) this.page.setConfiguration(q);
    else this.page.draw();
    this.pointSlider.setAttribute("aria-valuetext", `${index + 1}: ${this.sentences()[0]}`);
  }

  sentences(): [string, string] {
    const { cloud, chosen } = this;
    if (!cloud) return [this.text("studio_region"), this.text("studio_region_detail")];
    if (chosen < 0) return [this.text("studio_select_point"), this.text("studio_region_detail")];
    const value = cloud.values[chosen];
    const headline = cloud.q[chosen] === null ? this.text("studio_unreached_point")
      : this.text("studio_point_value", { value: formatNumber(value) });
    return [headline, this.text("studio_point_detail", { number: chosen + 1, count: cloud.points.length })];
  }
}

class WatchStep extends MotionStep {
  readonly show = "watch";
  readonly hasTarget = true;
  private watch: Watch | null = null;
  private readonly panels = h("div");
  private readonly findings = h("ul", { class: "studio-list" });
  private readonly readout = h("output");
  private readonly onset = this.slider("studio_onset", LATEST_ONSET_S, 0.1, 0, (time) => this.setFault(2, time));
  private readonly inject = this.button("studio_inject", () => {
    this.setFault(2, Math.round(10 * Math.min(this.playback.player.time, LATEST_ONSET_S)) / 10);
    void this.run();
  });

  enter(): void {
    const { data, studio } = this.page;
    const [kind, joint, onset] = studio.fault;
    this.setFault(2, onset);
    const row = h("label", {}, h("span", {}, this.text("studio_onset")), this.onset, this.readout);
    this.page.controls.replaceChildren(
      this.page.createMenu(this.text("studio_fault"), data.studio.faults, kind, (choice) => this.setFault(0, choice)),
      this.page.createMenu(this.text("studio_joint"), studio.names, joint, (choice) => this.setFault(1, choice)),
      row,
      this.row(this.button("studio_watch", () => void this.run()), this.inject),
      this.playback.element,
      this.panels,
      this.findings,
    );
    void this.page.chooseTarget();
  }

  async run(): Promise<void> {
    await this.page.chooseTarget();
    const watch = await this.page.run("watch");
    if (!watch) return;
    this.watch = watch;
    this.inject.disabled = false;
    this.open([watch.motion]);
  }

  sentences(): [string, string] {
    if (!this.watch) return [this.text("studio_watch_before"), this.text("studio_watch_detail")];
    const { alarm, onset } = this.watch;
    if (alarm === null || this.playback.player.time < alarm) return [this.text("studio_no_alarm"), this.text("studio_signals")];
    const delay = onset === null || alarm < onset ? this.text("studio_false_alarm", { time: alarm.toFixed(2) })
      : this.text("studio_alarm", { delay: Math.round(1000 * (alarm - onset)) });
    return [delay, this.text("studio_signals")];
  }

  protected override showTime(): void {
    if (!this.watch) return;
    const { watch, playback: { player: { time } } } = this;
    this.panels.replaceChildren(...drawSignals(watch, time, this.page.data.jointLabels, this.page.data.texts));
    const sentences = watch.sentences.filter(({ from }) => from <= time + 1e-9);
    if (sentences.length !== this.findings.childElementCount) {
      this.findings.replaceChildren(...sentences.map(({ text }) => h("li", {}, text)));
    }
  }

  override discard(): void {
    super.discard();
    this.watch = null;
    this.inject.disabled = true;
    this.panels.replaceChildren();
    this.findings.replaceChildren();
  }

  private setFault(part: 0 | 1 | 2, value: string | number): void {
    (this.page.studio.fault as (string | number)[])[part] = value;
    const onset = this.page.studio.fault[2];
    this.onset.value = String(onset);
    this.readout.textContent = `${onset.toFixed(1)} s`;
    this.onset.setAttribute("aria-valuetext", this.readout.textContent);
  }
}

class FileStep extends MotionStep {
  readonly show = "file";
  private readonly picker = createFilePicker(this.text("studio_open_file"), ".urdf,.xml,.yaml,.yml,.csv", (file) => {
    this.page.openStep("file");
    void this.openFile(file);
  });

  enter(): void {
    const { state, objects } = this.page.data.studio;
    const { name } = this.page.data;
    this.page.controls.replaceChildren(
      this.picker,
      this.row(
        state.file === null ? null : this.button("studio_open_motion", () => void this.run()),
        this.button("studio_png", () => void savePicture(this.page.view, `${name}.png`)),
        this.button("studio_svg", () => void this.saveDrawing()),
        objects.length ? this.button("studio_save_cell", () => void this.saveCell()) : null,
      ),
      this.playback.element,
    );
  }

  async run(): Promise<void> {
    await this.ask();
  }

  async openFile(file: File): Promise<void> {
    if (file.size > MAX_FILE_BYTES) return this.page.report(this.text("studio_too_large", { name: file.name }), true);
    const url = await new Promise<string>((done) => {
      const reader = new FileReader();
      reader.onload = () => done(String(reader.result));
      reader.readAsDataURL(file);
    });
    await this.ask({ name: file.name, content: url.slice(url.indexOf(",") + 1) });
  }

  sentences(): [string, string] {
    return [this.text("studio_file"), this.text("studio_file_detail")];
  }

  private async ask(file?: { name: string; content: string }): Promise<void> {
    const answer = await this.page.run("open", {}, { file });
    if (!answer) return;
    if ("motion" in answer) this.open([answer.motion]);
    else if (/^\/arm\/\d+\/$/.test(answer.address)) location.assign(answer.address);
  }

  private async saveDrawing(): Promise<void> {
    const ghosts = this.ghosts.map((q) => Array.from(q));
    const answer = await this.page.run("drawing", {}, { ghosts });
    if (answer) saveFile(`${this.page.data.name}.svg`, new Blob([answer.svg], { type: "image/svg+xml" }));
  }

  private async saveCell(): Promise<void> {
    const answer = await this.page.run("cell-file");
    if (!answer) return;
    saveFile(answer.name, new Blob([answer.text], { type: "text/yaml" }));
    this.page.report(this.text("studio_saved_cell", { name: answer.name, command: answer.command }));
  }
}

/** The step of the page, with dry friction and the fall that the server simulates. */
class StudioPowerStep extends PowerStep<StudioPage> implements StudioStepParts {
  private readonly forecast = h("p", { class: "bars-note" });
  readonly show = "fall";
  override readonly playback = new Playback(this.page, ["purple"], () => {
    this.ghosts = this.playback.configurations;
    this.page.draw();
  });

  override enter(): void {
    const kept = [...this.page.state.conditions];
    super.enter();
    if (kept.includes("free")) this.page.state.conditions.splice(0, kept.length, ...kept);
    this.ghostColors = ["purple"];
    const { friction } = this.page.studio;
    const input = h("input", { type: "number", min: 0, step: 0.1, value: friction ?? "" });
    input.addEventListener("change", () => {
      this.page.studio.friction = input.value === "" ? null : Math.max(0, Number(input.value));
      this.discard();
      this.page.changeConditions(() => undefined);
    });
    this.page.controls.append(
      h("label", {}, h("span", {}, this.text("studio_friction")), input),
      this.row(this.button("studio_cut", () => void this.run()), this.button("studio_stow", () => void this.run("stow"))),
      this.forecast,
      this.playback.element,
    );
  }

  async run(job: "fall" | "stow" = "fall"): Promise<void> {
    const motions = await this.page.run(job, { show: "fall" });
    if (motions) this.playback.open(motions, this.page.takeTime());
  }

  showReading(): void {
    this.forecast.textContent = this.page.reading?.powerLoss ?? "";
  }

  override update(): void {
    if (!this.playback.motions.length) super.update();
  }

  discard(): void {
    this.playback.close();
  }
}

export const STUDIO_STEPS = {
  ...STEP_CLASSES,
  power: StudioPowerStep,
  choose: ChooseStep,
  laws: LawsStep,
  region: RegionStep,
  watch: WatchStep,
  file: FileStep,
} as unknown as StepClasses;
