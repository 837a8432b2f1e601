/** The page of one arm: its state, and how the parts of the page follow it. */

import { sum } from "../viewer/algebra";
import type { Pose, Vector } from "../viewer/scene";
import { Overlay } from "../viewer/overlay";
import { View } from "../viewer/view";
import { readAddress, STEPS, writeAddress, type Condition, type PageState, type StepName } from "./address";
import { ArmModel } from "./arm_model";
import { Bars } from "./bars";
import { writeCommands } from "./commands";
import type { ArmPageData, PrintedKernels } from "./data";
import { relativeManipulability, worstJoint } from "./failures";
import { fillText, joinNames } from "./phrases";
import { STEP_CLASSES, type Step } from "./steps";
import { reachTarget, searchTarget } from "./tool_drag";
import { ToolHandle } from "./tool_handle";

const REST_MS = 400; // without change, until the page reports a state and computes what takes long
const KEY_STEP = 0.005; // of the stretched arm, for the smallest step by key

export class ArmPage {
  readonly arm: ArmModel;
  readonly controls: HTMLElement;
  readonly state: PageState;
  readonly reducedMotion = matchMedia("(prefers-reduced-motion: reduce)").matches;
  fractions: Float64Array = new Float64Array();
  worst = 0;
  touched = false;
  private readonly view: View;
  private readonly overlay: Overlay;
  private readonly bars: Bars;
  private readonly handle: ToolHandle;
  private readonly steps: Record<StepName, Step>;
  /** Pose that the tool should have, while it does not have it. */
  private target: Pose | null = null;
  private dragStart: Pose = [];
  private restTimer = 0;

  constructor(
    private readonly section: HTMLElement,
    readonly data: ArmPageData,
    kernels: PrintedKernels,
    box: HTMLElement,
    canvas: HTMLCanvasElement,
  ) {
    this.arm = new ArmModel(kernels, data.scene.joints, data.taskRows);
    this.view = new View(box, canvas, data.scene, { frames: (q) => this.arm.frames(q).map((pose) => [...pose]), plain: true });
    this.overlay = new Overlay(this.view);
    this.controls = this.find(".step-controls") ?? document.createElement("div");
    const conditions = data.scene.locked.map((time): Condition => (time === null ? "healthy" : "locked"));
    const step = conditions.includes("locked") ? "lock" : "healthy";
    const defaults: PageState = { arm: data.name, step, q: data.scene.arms[0].q[0], conditions, brakeDelay: 150 };
    this.state = readAddress(location.hash, data, defaults);
    this.bars = new Bars(this.find(".bars") as HTMLElement, data.texts, (joint, condition) =>
      this.selectCondition(joint, condition),
    );
    this.handle = new ToolHandle(this.addHandle(), {
      begin: () => this.beginDrag(),
      drag: (right, down) => this.drag(right, down),
      step: (right, up, gravity) => this.moveByKeys(right, up, gravity),
      end: () => this.endDrag(),
    });
    this.steps = Object.fromEntries(STEPS.map((name) => [name, new STEP_CLASSES[name](this)])) as Record<StepName, Step>;
    this.addStepButtons();
    (this.find(".view3d-hint") as HTMLElement).textContent = data.texts.hint;
    this.view.onDraw = () => this.afterPicture();
    this.measure();
    this.openStep(this.state.step);
  }

  // ---- state -------------------------------------------------------------------------------------------------------

  get failed(): number[] {
    return this.state.conditions.flatMap((condition, joint) => (condition === "healthy" ? [] : [joint]));
  }

  /** Target of the undetected lock, m, which moves with the tool when the visitor drags it. */
  get controlTarget(): Vector {
    const { story } = this.data;
    const tool = this.arm.toolPosition(this.state.q);
    return story === null ? tool : sum(sum(tool, story.target), this.arm.toolPosition(story.start), -1);
  }

  label(joint: number): string {
    return this.data.jointLabels[joint];
  }

  failedNames(): string {
    return joinNames(this.failed.map((joint) => this.label(joint)));
  }

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

  private selectCondition(joint: number, condition: Condition): void {
    this.touched = true;
    this.setCondition(joint, condition);
    if (this.state.step === "healthy" || this.state.step === "prepare") this.openStep("lock");
    else this.update();
  }

  private openStep(name: StepName): void {
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

  private get step(): Step {
    return this.steps[this.state.step];
  }

  // ---- dragging ----------------------------------------------------------------------------------------------------

  private beginDrag(): void {
    this.touched = true;
    this.dragStart = [...this.arm.toolPose(this.state.q)];
  }

  private drag(right: number, down: number): void {
    const start = positionOf(this.dragStart);
    this.moveTool(sum(this.view.displace(start, right, down), start, -1), this.dragStart);
  }

  private moveByKeys(right: number, up: number, gravity: number): void {
    this.touched = true;
    const axes = this.view.camera.axes();
    const length = KEY_STEP * this.data.scene.size;
    const flat = sum(sum([0, 0, 0], axes.right, right * length), axes.top, up * length);
    this.moveTool(sum(flat, this.data.scene.up, -gravity * length), this.target ?? [...this.arm.toolPose(this.state.q)]);
  }

  private moveTool(displacement: Vector, from: Pose): void {
    const target = [...from];
    displacement.forEach((value, k) => (target[4 * k + 3] += value));
    const found = reachTarget(this.arm, this.state.q, target, this.arm.freeJoints(this.failed));
    this.state.q = [...found.configuration];
    this.target = found.reached ? null : target;
    this.update();
  }

  /** Search from random starts for a target that was not reached from the present configuration. */
  private endDrag(): void {
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
  private update(): void {
    this.measure();
    this.section.dataset.touched = String(this.touched);
    this.bars.update([...this.fractions], this.worst, this.state.conditions);
    this.step.update();
    this.draw();
  }

  /** Draw the picture and write the sentences. */
  draw(): void {
    this.view.setConditions(this.state.conditions.map((condition) => (condition === "healthy" ? null : condition)));
    this.view.setGhosts(this.step.ghosts.map((q) => [...Array.from(q)]));
    this.view.pose([...Array.from(this.step.configuration)]);
    const [headline, detail] = this.target === null ? this.step.sentences() : this.unreachedSentences();
    (this.find(".arm-headline") as HTMLElement).textContent = headline;
    (this.find(".arm-detail") as HTMLElement).textContent = detail;
    clearTimeout(this.restTimer);
    this.restTimer = window.setTimeout(() => this.reportRest(headline), REST_MS);
  }

  private unreachedSentences(): [string, string] {
    const { texts, scene } = this.data;
    const distance = Math.hypot(...sum(positionOf(this.target as Pose), positionOf(scene.base), -1));
    if (distance > scene.size) return [texts.too_far, texts.unreached_detail];
    const headline = this.failed.length ? fillText(texts.unreached, { joints: this.failedNames() }) : texts.unreached_healthy;
    return [headline, texts.unreached_detail];
  }

  /** Tell a screen reader, the address, and the commands once nothing has changed for a while. */
  private reportRest(headline: string): void {
    (this.find("[aria-live]") as HTMLElement).textContent = headline;
    try {
      history.replaceState(null, "", writeAddress(this.state));
    } catch {
      // A page in a sandboxed frame has no address of its own.
    }
    writeCommands(this.find(".arm-commands") as HTMLElement, this.data, this.state, this.worst, this.controlTarget);
  }

  /** Place what lies over the picture. */
  private afterPicture(): void {
    const tool = this.arm.toolPosition(this.state.q);
    const goal = this.target === null ? tool : positionOf(this.target);
    this.handle.place(this.view.project(goal));
    this.overlay.show({ ...this.step.overlay(), ...(this.target === null ? {} : { pointerLine: [tool, goal] }) });
  }

  private addHandle(): HTMLButtonElement {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "tool-handle";
    button.setAttribute("aria-label", this.data.texts.handle);
    this.find(".view3d-stage")?.append(button);
    return button;
  }

  private addStepButtons(): void {
    const list = this.find(".arm-steps");
    list?.removeAttribute("hidden");
    for (const button of list?.querySelectorAll<HTMLButtonElement>("button") ?? []) {
      const name = button.dataset.step as StepName;
      if (name === "power" && this.arm.kernels.accelerations === null) button.parentElement?.remove();
      if (name === "undetected" && this.data.story === null) button.parentElement?.remove();
      button.addEventListener("click", () => {
        this.touched = true;
        this.openStep(name);
      });
    }
  }

  private find(selector: string): HTMLElement | null {
    return this.section.querySelector<HTMLElement>(selector);
  }
}

const positionOf = (pose: Pose): Vector => [pose[3], pose[7], pose[11]];
