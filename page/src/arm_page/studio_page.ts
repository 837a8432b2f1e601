/** The page of the studio: the page of an arm, with what a local server computes for it. */

import { createMenu, h } from "../dom";
import { inverse, place, times } from "../viewer/algebra";
import type { OverlayContent } from "../viewer/overlay";
import type { Part, Pose } from "../viewer/scene";
import { readAddress, type PageState } from "./address";
import { ask, type Answers, type AskOptions, type JointBars, type Question, type StudioData, type StudioState } from "./answers";
import { ArmPage } from "./arm_page";
import type { BarValues } from "./bars";
import type { Code } from "./commands";
import type { ArmPageData } from "./data";
import { fillText } from "./phrases";
import type { PoseHandle } from "./pose_handle";
import { numbersFromPose, poseFromNumbers } from "./pose_numbers";

/** The index that the page computes itself. */
const OWN_INDEX = "relative-manipulability";
/** Step that shows the content of `StudioState.show`. */
const SHOW_STEPS: Record<string, string> = {
  "best-worst": "choose", laws: "laws", fall: "power", region: "region", file: "file", watch: "watch",
};
export const MAX_FILE_BYTES = 4 << 20;

/** What the studio asks of some steps. */
export interface StudioStepParts {
  /** Content of `StudioState.show` once the step has a result. */
  show?: string;
  /** Whether the step has a target, with a handle. */
  hasTarget?: boolean;
  /** Compute what the step shows. */
  run?: () => Promise<void>;
  /** Discard a result that another configuration, condition, or position of an object has made obsolete. */
  discard?: () => void;
  /** Show a new answer to the question `reading`. */
  showReading?: () => void;
  choosePoint?: (index: number) => void;
}

type StudioPageData = ArmPageData & { studio: StudioData };

export class StudioPage extends ArmPage<StudioPageData> {
  /** The state without what `PageState` has: choices, target, objects, and files. */
  readonly studio: StudioState = { ...this.data.studio.state };
  reading: Answers["reading"] | null = null;
  private readonly ownNote = this.find(".bars-note")?.textContent ?? "";
  private asking = false;
  private askedState = "";
  private job: AbortController | null = null;
  /** What the result of a step depends on. */
  private resultBasis = "";
  private readonly status = h("p", { class: "studio-status", role: "status" });
  private readonly progress = h("progress", { "aria-label": this.data.texts.studio_progress });
  private readonly cancelButton = h("button", { type: "button", onclick: () => this.cancel() }, this.data.texts.studio_cancel);
  private readonly work = h("div", { class: "step-row", hidden: true }, this.progress, this.cancelButton);
  private readonly clearance = h("p", { class: "view3d-note studio-clearance" });
  private readonly susceptibilityList = h("div", { class: "studio-susceptibilities" });
  private readonly targetHandle: PoseHandle = this.addHandle("target-handle", "studio_target_handle", {
    move: (pose) => this.setTarget(numbersFromPose(pose)),
  });
  private readonly objectLabel = createMenu(
    this.data.texts.studio_object,
    [this.data.texts.studio_none, ...this.data.studio.objects.map(({ name }) => name)],
    0,
    () => this.afterPicture(),
  );
  private readonly objectMenu = this.objectLabel.control as HTMLSelectElement;
  private readonly objectPoses: Pose[] = this.data.studio.objects.map(({ name, pose }) => {
    const moved = this.studio.moved.find(([object]) => object === name);
    return moved ? poseFromNumbers(moved[1]) : pose;
  });
  private readonly objectHandle: PoseHandle = this.addHandle("object-handle", "studio_object_handle", {
    move: (pose) => this.moveObject(pose),
  }, [0, 1, 2]);

  override start(): void {
    const { texts, studio } = this.data;
    this.controls.after(this.work, this.status);
    const menu = this.createMenu(texts.studio_index, studio.indices, this.studio.index, (index) => (this.studio.index = index));
    this.find(".bars")?.before(menu);
    const kinds = this.createMenu(texts.studio_susceptibility, studio.susceptibilities, this.studio.susceptibility, (kind) => {
      this.studio.susceptibility = kind;
    });
    const summary = h("summary", {}, texts.studio_susceptibilities);
    this.find(".arm-commands")?.before(h("details", {}, summary, kinds, this.susceptibilityList));
    this.view.box.addEventListener("view3d:point", (event) => this.parts.choosePoint?.((event as CustomEvent<number>).detail));
    this.placeObjects();
    super.start();
    if (SHOW_STEPS[this.studio.show] === this.state.step) void this.parts.run?.();
  }

  private get parts(): StudioStepParts {
    return this.step as StudioStepParts;
  }

  protected override readState(defaults: PageState, steps: string[]): PageState {
    const { q, conditions, show } = this.data.studio.state;
    const step = SHOW_STEPS[show] ?? (conditions.every((condition) => condition === "healthy") ? "healthy" : "lock");
    return readAddress(location.hash, this.data, { ...defaults, q, conditions: [...conditions], step }, steps);
  }

  /** The view, as the server reads it. */
  get studioState(): StudioState {
    const { playback } = this.step;
    const isShown = playback === null || playback.motions.length > 0;
    return {
      ...this.studio,
      q: Array.from(this.state.q),
      conditions: [...this.state.conditions],
      show: (isShown && this.parts.show) || "arm",
      time: (isShown && playback?.player.time) || 0,
    };
  }

  /** Return the time, s, at which the command line shows the first motion, and 0 after that. */
  takeTime(): number {
    const { time } = this.studio;
    this.studio.time = 0;
    return time;
  }

  createMenu(label: string, options: string[], selected: string, choose: (option: string) => void): HTMLLabelElement {
    const menu = createMenu(label, options, options.indexOf(selected), (index) =>
      this.changeConditions(() => choose(options[index])),
    );
    menu.className = "studio-menu";
    return menu;
  }

  override openStep(name: string): void {
    this.cancel();
    this.report("");
    this.resultBasis = "";
    super.openStep(name);
  }

  // ---- questions ---------------------------------------------------------------------------------------------------

  /** Ask a question that may take seconds; null if it failed or was cancelled, which the page reports. */
  async run<Q extends Question>(
    question: Q,
    changes: Partial<StudioState> = {},
    options: AskOptions = {},
  ): Promise<Answers[Q] | null> {
    this.cancel();
    const job = (this.job = new AbortController());
    this.report("");
    this.progress.removeAttribute("value");
    this.work.hidden = false;
    const progress = (done: number, total: number): void => {
      if (this.job === job) [this.progress.max, this.progress.value] = [total, done];
    };
    try {
      const state = { ...this.studioState, ...changes };
      return await ask(question, this.data.studio.token, state, { ...options, signal: job.signal, progress });
    } catch (error) {
      if (!job.signal.aborted) this.reportError(error);
      return null;
    } finally {
      if (this.job === job) this.work.hidden = true;
    }
  }

  /** Cancel the question that is being answered. */
  cancel(): void {
    this.job?.abort();
    if (!this.work.hidden) this.report(this.data.texts.studio_cancelled);
    this.work.hidden = true;
  }

  report(text: string, isError = false): void {
    this.status.textContent = text;
    this.status.classList.toggle("studio-error", isError);
  }

  private reportError(error: unknown): void {
    // A browser reports a server that has stopped in its own words.
    const text = error instanceof Error && !(error instanceof TypeError) ? error.message : this.data.texts.studio_stopped;
    this.report(text, true);
  }

  protected override update(): void {
    const basis = JSON.stringify([Array.from(this.state.q), this.state.conditions, this.studio.moved]);
    if (basis !== this.resultBasis) this.parts.discard?.();
    this.resultBasis = basis;
    super.update();
    void this.askReading();
  }

  /** Ask for the numbers of the present state, one question at a time. */
  private async askReading(): Promise<void> {
    if (this.asking) return;
    this.asking = true;
    while (this.askedState !== JSON.stringify(this.studioState)) {
      this.askedState = JSON.stringify(this.studioState);
      try {
        this.reading = await ask("reading", this.data.studio.token, this.studioState);
        this.showReading(this.reading);
      } catch (error) {
        this.reportError(error);
      }
    }
    this.asking = false;
  }

  protected override reportRest(headline: string): void {
    super.reportRest(headline);
    void this.askReading();
  }

  /** A target for the end effector: the chosen one, or one near the tool. */
  async chooseTarget(another = false): Promise<void> {
    if (this.studio.target !== null && !another) return;
    try {
      const { target } = await ask("reading", this.data.studio.token, this.studioState);
      this.setTarget(target);
    } catch (error) {
      this.reportError(error);
    }
  }

  private setTarget(target: number[]): void {
    this.studio.target = target;
    this.update();
  }

  // ---- showing -----------------------------------------------------------------------------------------------------

  private showReading({ clearance, nearest, susceptibility }: Answers["reading"]): void {
    const bars = this.barValues();
    this.bars.update(bars, this.state.conditions);
    this.clearance.textContent = clearance;
    this.clearance.classList.toggle("studio-error", nearest?.blocked ?? false);
    this.view.touchedObject = nearest?.blocked ? this.data.studio.objects.findIndex(({ name }) => name === nearest.name) : -1;
    this.susceptibilityList.replaceChildren(...this.listSusceptibilities(susceptibility));
    this.parts.showReading?.();
    this.showCode();
    this.draw();
  }

  protected override barValues(): BarValues {
    const answer = this.reading?.index ?? "";
    const { texts, jointLabels } = this.data;
    const isOwn = this.studio.index === OWN_INDEX;
    const note = isOwn ? this.ownNote : typeof answer === "string" ? answer
      : fillText(texts[`studio_${answer.better}`], { title: answer.title, unit: commonUnit(answer) }) +
        (answer.status ? ` (${answer.status})` : "");
    (this.find(".bars-note") as HTMLElement).textContent = note;
    const bars = this.find(".bars") as HTMLElement;
    bars.toggleAttribute("data-other-index", !isOwn);
    bars.setAttribute("aria-label", note);
    if (isOwn) return super.barValues();
    if (typeof answer === "string") {
      return { fractions: jointLabels.map(() => 0), texts: jointLabels.map(() => ""), worst: -1, meaning: texts.studio_bar };
    }
    return { ...scaleBars(answer), worst: answer.worst, meaning: texts.studio_bar };
  }

  /** Bars for joints that lose their torque. */
  private listSusceptibilities(bars: JointBars | string): HTMLElement[] {
    if (typeof bars === "string") return [h("p", {}, bars)];
    const { fractions, texts } = scaleBars(bars);
    const rows = texts.map((text, k) => {
      const worst = k === bars.worst ? this.data.texts.worst : "";
      const track = h("span", { class: "bar-track" }, h("i"));
      track.style.setProperty("--fraction", String(fractions[k]));
      return h("li", {}, h("span", { class: "bar-name" }, this.data.jointLabels[k]), track, h("span", {}, text, " ", worst));
    });
    const title = fillText(this.data.texts.studio_torque, { title: bars.title, unit: commonUnit(bars) });
    return [h("p", { class: "bars-note" }, title), h("ul", {}, ...rows)];
  }

  protected override listCode(): Code[] {
    const command: Code[] = this.reading ? [{ kind: "studio", text: this.reading.command }] : [];
    return [...command, ...super.listCode()];
  }

  protected override overlayContent(): OverlayContent {
    const content = super.overlayContent();
    const { nearest } = this.reading ?? {};
    const { target } = this.studio;
    if (nearest && !nearest.blocked) content.nearestLine = [nearest.arm, nearest.object];
    if (this.parts.hasTarget && target) {
      content.pointerLine ??= [this.arm.toolPosition(this.state.q), place(poseFromNumbers(target))];
    }
    return content;
  }

  protected override afterPicture(): void {
    super.afterPicture();
    const { target } = this.studio;
    this.targetHandle.place(this.parts.hasTarget && target ? poseFromNumbers(target) : null);
    this.objectHandle.place(this.objectPoses[this.objectMenu.selectedIndex - 1] ?? null);
  }

  // ---- objects -----------------------------------------------------------------------------------------------------

  protected override addPictureButtons(): void {
    super.addPictureButtons();
    this.objectLabel.className = "studio-menu";
    if (this.objectPoses.length) this.find(".view3d-controls")?.append(this.objectLabel, this.clearance);
  }

  protected override selectPart(part: Part): void {
    if (!part.object) return super.selectPart(part);
    const chosen = this.view.objectIndex(part) + 1;
    this.objectMenu.selectedIndex = this.objectMenu.selectedIndex === chosen ? 0 : chosen;
    this.afterPicture();
  }

  private moveObject(pose: Pose): void {
    const index = this.objectMenu.selectedIndex - 1;
    const { name } = this.data.studio.objects[index];
    this.objectPoses[index] = pose;
    this.studio.moved = [...this.studio.moved.filter(([object]) => object !== name), [name, numbersFromPose(pose)]];
    this.placeObjects();
    this.update();
  }

  private placeObjects(): void {
    this.view.objectMotions = this.objectPoses.map((pose, k) => times(pose, inverse(this.data.studio.objects[k].pose)));
  }
}

/** Lengths and texts of bars; an infinite value has the longest bar. */
function scaleBars({ values, better, unit }: JointBars): { fractions: number[]; texts: string[] } {
  const largest = Math.max(...values.map((value) => value ?? 0)) || 1;
  const suffix = (k: number): string => (new Set(unit).size > 1 && unit[k] !== "1" ? ` ${unit[k]}` : "");
  return {
    fractions: values.map((value) => (value === null ? Number(better === "smaller") : Math.max(0, value / largest))),
    texts: values.map((value, k) =>
      value === null ? (better === "smaller" ? "infinite" : "none") : `${formatNumber(value)}${suffix(k)}`),
  };
}

/** Return ", unit" if all bars have the same unit, and an empty text otherwise. */
const commonUnit = ({ unit }: JointBars): string => (new Set(unit).size === 1 && unit[0] !== "1" ? `, ${unit[0]}` : "");

/** A number with three digits; null is infinite. */
export const formatNumber = (value: number | null): string =>
  value === null ? "infinite" : Math.abs(value) < 1e-12 ? "0" : String(Number(value.toPrecision(3)));
