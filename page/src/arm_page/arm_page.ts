/** The page of one arm: its state, and how the parts of the page follow it. */

import { h, setText } from "../dom";
import { place, sum } from "../viewer/algebra";
import type { Part, Pose, Scene, Vector } from "../viewer/scene";
import { findBody } from "../viewer/hulls";
import { Overlay, type OverlayContent } from "../viewer/overlay";
import { createToggle, createViewButtons, JointSliders } from "../viewer/controls";
import { listJoints, readAddress, writeAddress, type Condition, type PageState } from "./address";
import { ArmModel } from "./arm_model";
import { Bars, NEXT_CONDITION, type BarValues } from "./bars";
import { reproduce, writeCommands, type Code } from "./commands";
import type { ArmPageData, PrintedKernels } from "./data";
import { relativeManipulability, worstJoint } from "./failures";
import { PageView } from "./page_view";
import { fillText, formatPercent, joinNames } from "./phrases";
import { PoseHandle, type HandleActions } from "./pose_handle";
import type { Step, StepClasses } from "./steps";
import { followTarget, searchTarget } from "./tool_drag";

const REST_MS = 400; // without change, until the page reports a state and computes what takes long

export class ArmPage<Data extends ArmPageData = ArmPageData> {
  readonly arm: ArmModel;
  readonly controls: HTMLElement;
  readonly state: PageState;
  readonly reducedMotion = matchMedia("(prefers-reduced-motion: reduce)").matches;
  fractions: Float64Array = new Float64Array();
  worst = 0;
  touched = false;
  dragging = false;
  readonly view: PageView;
  protected readonly overlay: Overlay;
  protected readonly bars: Bars;
  protected readonly handles: PoseHandle[] = [];
  protected readonly handle: PoseHandle;
  private readonly sliders: JointSliders;
  private readonly steps: Record<string, Step>;
  /** Pose that the tool should have, while it does not have it. */
  private target: Pose | null = null;
  private restTimer = 0;

  constructor(
    protected readonly section: HTMLElement,
    readonly data: Data,
    kernels: PrintedKernels,
    box: HTMLElement,
    canvas: HTMLCanvasElement,
    private readonly stepClasses: StepClasses,
  ) {
    this.arm = new ArmModel(kernels, data.scene.joints, data.taskRows);
    this.view = new PageView(box, canvas, data.scene, this.arm);
    this.overlay = new Overlay(this.view);
    this.controls = this.find(".step-controls") ?? document.createElement("div");
    const conditions = data.scene.locked.map((time): Condition => (time === null ? "healthy" : "locked"));
    const defaults: PageState = { arm: data.name, step: "healthy", q: data.scene.arms[0].q[0], conditions, brakeDelay: 150 };
    this.state = this.readState(defaults, Object.keys(stepClasses));
    this.bars = new Bars(this.find(".bars") as HTMLElement, data.texts, (joint, condition) =>
      this.selectCondition(joint, condition),
    );
    this.handle = this.addHandle("tool-handle", "handle", {
      begin: () => (this.touched = this.dragging = true),
      move: (pose) => this.moveTool(pose),
      end: () => this.endDrag(),
    });
    const names = data.scene.joints.map(({ name }) => name);
    this.sliders = new JointSliders(data.scene, this.state.q, names, (q) => this.setConfiguration(q));
    this.steps = Object.fromEntries(Object.entries(stepClasses).map(([name, kind]) => [name, new kind(this)]));
  }

  /** Show the first step. */
  start(): void {
    const { data, view } = this;
    this.addStepButtons();
    this.addPictureButtons();
    this.find(".arm-commands")?.before(this.sliders.element);
    (this.find(".view3d-hint") as HTMLElement).textContent = data.texts.hint;
    view.onDraw = () => this.afterPicture();
    view.onClick = (point) => this.selectPartAt(point);
    this.measure();
    this.openStep(this.state.step);
  }

  /** The state in the address, or the one that the page was written for. */
  protected readState(defaults: PageState, steps: string[]): PageState {
    const step = defaults.conditions.every((condition) => condition === "healthy") ? "healthy" : "lock";
    return readAddress(location.hash, this.data, { ...defaults, step }, steps);
  }

  // ---- state -------------------------------------------------------------------------------------------------------

  get failed(): number[] {
    return listJoints(this.state.conditions, "locked", "free");
  }

  /** Whether a motion of the joints is left that keeps the tool where it is. */
  get hasSelfMotion(): boolean {
    return this.failed.length < this.arm.redundancy;
  }

  /** Target of the undetected lock, m, which moves with the tool when the visitor drags it. */
  get controlTarget(): Vector {
    const { story } = this.data;
    const tool = this.arm.toolPosition(this.state.q);
    return story === null ? tool : sum(sum(tool, story.target), this.arm.toolPosition(story.start), -1);
  }

  failedNames = (): string => joinNames(this.failed.map((joint) => this.data.jointLabels[joint]));

  repairAll(): void {
    this.state.conditions.fill("healthy");
  }

  setCondition(joint: number, condition: Condition): void {
    this.state.conditions[joint] = condition;
  }

  /** Change conditions of joints, and show the result. */
  changeConditions(change: () => void): void {
    change();
    this.update();
  }

  setConfiguration(q: ArrayLike<number>): void {
    this.state.q = q;
    this.target = null;
    this.touched = true;
    this.update();
  }

  private selectPartAt(point: number[]): void {
    const parts = this.data.scene.parts.filter((part) => part.joint !== undefined || part.object);
    const poses = this.view.frames();
    const bodies = parts.map((part) => ({ part, pose: this.view.placePart(part, poses) }));
    const found = findBody(bodies, (corner) => this.view.project(corner), point);
    if (found) this.selectPart(found.part);
  }

  /** Change the condition of the joint of a part of the picture. */
  protected selectPart({ joint }: Part): void {
    if (joint !== undefined) this.selectCondition(joint, NEXT_CONDITION[this.state.conditions[joint]]);
  }

  private selectCondition(joint: number, condition: Condition): void {
    this.touched = true;
    this.setCondition(joint, condition);
    const { step } = this.state;
    if (step === "healthy" || step === "prepare") this.openStep(step === "prepare" && this.hasSelfMotion ? step : "lock");
    else this.update();
  }

  openStep(name: string): void {
    this.step.leave();
    this.step.ghosts = [];
    this.state.step = name;
    this.target = null;
    for (const button of this.section.querySelectorAll<HTMLElement>(".arm-steps button")) {
      if (button.dataset.step === name) button.setAttribute("aria-current", "step");
      else button.removeAttribute("aria-current");
    }
    this.controls.replaceChildren();
    this.step.enter();
    this.update();
  }

  protected get step(): Step {
    return this.steps[this.state.step];
  }

  // ---- dragging ----------------------------------------------------------------------------------------------------

  private moveTool(target: Pose): void {
    const found = followTarget(this.arm, this.state.q, target, this.arm.freeJoints(this.failed));
    this.state.q = [...found.configuration];
    this.target = found.reached ? null : target;
    this.update();
  }

  /** Search from random starts for a target that was not reached from the present configuration. */
  private endDrag(): void {
    this.dragging = false;
    if (this.target !== null) {
      const found = searchTarget(this.arm, this.state.q, this.target, this.arm.freeJoints(this.failed));
      if (found.reached) this.setConfiguration([...found.configuration]);
    }
    this.step.rest();
    this.update();
  }

  // ---- showing -----------------------------------------------------------------------------------------------------

  private measure(): void {
    this.fractions = relativeManipulability(this.arm, this.state.q);
    this.worst = worstJoint(this.fractions);
  }

  /** Show the state in every part of the page. */
  protected update(): void {
    this.measure();
    this.section.dataset.touched = String(this.touched);
    const { conditions, q } = this.state;
    this.bars.update(this.barValues(), conditions);
    this.sliders.update(q, conditions.map((condition) => condition === "healthy"));
    this.step.update();
    this.draw();
  }

  protected barValues(): BarValues {
    const fractions = [...this.fractions];
    return { fractions, texts: fractions.map(formatPercent), worst: this.worst, meaning: this.data.texts.bar };
  }

  /** Draw the picture and write the sentences. */
  draw(): void {
    const { configuration, ghosts, ghostColors } = this.step;
    this.view.show({
      q: Array.from(configuration),
      ghosts: ghosts.map((q) => Array.from(q)),
      ghostColors,
      conditions: this.state.conditions.map((condition) => (condition === "healthy" ? null : condition)),
    });
    const [headline, detail] = this.target === null ? this.step.sentences() : this.unreachedSentences();
    setText(this.find(".arm-headline") as HTMLElement, headline);
    setText(this.find(".arm-detail") as HTMLElement, detail);
    clearTimeout(this.restTimer);
    this.restTimer = window.setTimeout(() => this.reportRest(headline), REST_MS);
  }

  private unreachedSentences(): [string, string] {
    const { texts, scene } = this.data;
    const distance = Math.hypot(...sum(place(this.target as Pose), place(scene.base), -1));
    if (distance > scene.size) return [texts.too_far, texts.unreached_detail];
    const headline = this.failed.length ? fillText(texts.unreached, { joints: this.failedNames() }) : texts.unreached_healthy;
    return [headline, texts.unreached_detail];
  }

  /** Tell a screen reader, the address, and the commands once nothing has changed for a while. */
  protected reportRest(headline: string): void {
    setText(this.find("[aria-live]") as HTMLElement, headline);
    try {
      history.replaceState(null, "", writeAddress(this.state));
    } catch {
      // A page in a sandboxed frame has no address of its own.
    }
    this.showCode();
  }

  protected showCode(): void {
    writeCommands(this.find(".arm-commands") as HTMLElement, this.data.texts, this.listCode());
  }

  /** Commands and Python lines that reproduce what the page shows. */
  protected listCode(): Code[] {
    return reproduce(this.data, this.state, this.worst, this.controlTarget);
  }

  /** Place what lies over the picture. */
  protected afterPicture(): void {
    const tool = [...this.arm.toolPose(this.state.q)];
    this.handle.place(this.target ?? tool);
    this.overlay.show(this.overlayContent());
  }

  protected overlayContent(): OverlayContent {
    const content = this.step.overlay();
    if (this.target !== null) content.pointerLine = [this.arm.toolPosition(this.state.q), place(this.target)];
    return content;
  }

  /** Add a handle that moves a pose; `text` is the key of what a screen reader says. */
  protected addHandle(className: string, text: string, actions: HandleActions, axes = this.rotationAxes): PoseHandle {
    const { texts } = this.data;
    const labels: [string, string] = [texts[text], `${texts[text].split(".")[0]}. ${texts.handle_rotate}`];
    const handle = new PoseHandle(this.view, className, labels, axes, actions);
    this.handles.push(handle);
    return handle;
  }

  /** Axes, 0 to 2, about which the task prescribes rotations. */
  protected get rotationAxes(): number[] {
    return [0, 1, 2].filter((axis) => this.data.taskRows.some((row) => Math.abs(row[3 + axis]) > 0.5));
  }

  protected addPictureButtons(): void {
    const rotate = createToggle(this.data.texts.rotate, (on) => this.handles.forEach((handle) => handle.setRotating(on)));
    const goHome = (): void => this.setConfiguration(this.data.scene.arms[0].q[0]);
    const home = h("button", { type: "button", onclick: goHome }, this.data.texts.home);
    const toggle = this.rotationAxes.length ? rotate : null;
    const row = h("div", { class: "view3d-row" }, ...createViewButtons(this.view), toggle, home);
    this.find(".view3d-controls")?.append(row);
  }

  private addStepButtons(): void {
    const { arm, data } = this;
    const missing = [arm.kernels.accelerations === null ? "power" : "", data.story === null ? "undetected" : ""];
    const buttons = Object.keys(this.stepClasses).filter((name) => !missing.includes(name)).map((name) => {
      const onclick = (): void => {
        this.touched = true;
        this.openStep(name);
      };
      return h("li", {}, h("button", { type: "button", "data-step": name, onclick }, data.texts[`step_${name}`]));
    });
    this.find(".arm-steps")?.append(...buttons);
  }

  protected find(selector: string): HTMLElement | null {
    return this.section.querySelector<HTMLElement>(selector);
  }
}

declare const armKernels: Record<string, PrintedKernels>;
type PageClass = new (...args: ConstructorParameters<typeof ArmPage<any>>) => ArmPage;

/** Start the arm of the document at once, and another one when the menu has chosen it. */
export function startArms(pageClass: PageClass, steps: StepClasses): void {
  const start = (): void => {
    const section = document.querySelector(".arm") as HTMLElement & { armPage: ArmPage };
    const find = <Kind extends HTMLElement>(selector: string): Kind => section.querySelector(selector) as Kind;
    const read = (selector: string): unknown => JSON.parse(find(selector).textContent ?? "");
    const scene = { ...(read(".view3d > script") as Scene), parts: read(".view3d-body script") as Scene["parts"] };
    const data = { ...(read(".arm-data script") as ArmPageData), scene };
    section.armPage = new pageClass(section, data, armKernels[data.name], find(".view3d"), find("canvas"), steps);
    section.armPage.start();
  };
  document.querySelector(".arm-menu")?.addEventListener("change", start);
  start();
}
