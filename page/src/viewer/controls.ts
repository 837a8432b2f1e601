/** Buttons and sliders under a picture. */

import { h } from "../dom";
import type { Scene } from "./scene";
import type { View } from "./view";

const FASTEST = 1 / 30; // s between two pictures, with a little room

/** Add the controls to the page; the returned function shows a frame of the motion. */
export function controls(view: View): (k: number) => void {
  const { box, scene } = view;
  const row = h("div", { class: "view3d-row" });
  const last = view.length - 1;
  let shown = (_: number): void => undefined;
  if (scene.time.length) {
    const play = h("button", { type: "button" }, "Play");
    const slider = h("input", { type: "range", min: 0, max: last, step: 1, value: 0, "aria-label": "Time of the motion" });
    const said = h("output", { class: "view3d-said" });
    let timer = 0;
    let begun = 0;
    let from = 0;
    const stop = (): void => {
      cancelAnimationFrame(timer);
      timer = 0;
      play.textContent = "Play";
    };
    let before = 0;
    const tick = (now: number): void => {
      begun ||= now;
      timer = requestAnimationFrame(tick);
      const k = Math.min(last, from + ((now - begun) / 1000 / scene.seconds) * last);
      if (now - before < 900 * FASTEST && k < last) return;
      before = now;
      view.frame(k);
      if (k >= last) stop();
    };
    play.addEventListener("click", () => {
      if (timer) return stop();
      from = Number(slider.value) >= last ? 0 : Number(slider.value);
      begun = 0;
      play.textContent = "Pause";
      timer = requestAnimationFrame(tick);
    });
    slider.addEventListener("input", () => {
      stop();
      view.frame(Number(slider.value));
    });
    shown = (k) => {
      const text = scene.readings[Math.round(k)] ?? `${scene.time[Math.round(k)].toPrecision(3)} s`;
      slider.value = String(k);
      slider.setAttribute("aria-valuetext", text);
      if (said.textContent !== text) said.textContent = text;
    };
    shown(0);
    row.append(play, slider, said);
  }
  row.append(...createViewButtons(view));
  const fixed = scene.joints.map((joint, k) => (scene.locked[k] === null ? "" : `${joint.name} (locked)`));
  const sliders = scene.sliders ? [new JointSliders(scene, [...view.configurations()[0]], (q) => view.pose(q), fixed).element] : [];
  box.querySelector(".view3d-controls")?.append(row, ...sliders);
  return (k) => shown(k);
}

/** Buttons that reset the camera and that show or hide the names of the joints. */
export function createViewButtons(view: View): HTMLButtonElement[] {
  const reset = (): void => {
    view.camera.reset();
    view.draw();
  };
  const names = createToggle("Names", (on) => {
    view.names = on;
    view.draw();
  });
  return [h("button", { type: "button", onclick: reset }, "Reset the view"), names];
}

/** A button that is pressed or not. */
export function createToggle(label: string, change: (on: boolean) => void): HTMLButtonElement {
  const toggle = h("button", { type: "button", "aria-pressed": "false" }, label);
  toggle.addEventListener("click", () => {
    const on = toggle.getAttribute("aria-pressed") !== "true";
    toggle.setAttribute("aria-pressed", String(on));
    change(on);
  });
  return toggle;
}

/** A slider for each joint; one without limits goes once round. */
export class JointSliders {
  readonly element: HTMLDetailsElement;
  private readonly updates: ((value: number, enabled: boolean) => void)[];

  /** `fixed` has the label of each joint that cannot move, and an empty text for the others. */
  constructor(scene: Scene, private q: number[], change: (q: number[]) => void, fixed: string[] = []) {
    const rows: HTMLElement[] = [];
    this.updates = scene.joints.map((joint, k) => {
      const free = joint.slides ? scene.size : Math.PI;
      const [low, high] = [joint.low ?? Math.min(-free, q[k]), joint.high ?? Math.max(free, q[k])];
      const slider = h("input", { type: "range", min: low, max: high, step: "any", value: q[k] });
      const readout = h("output");
      const showValue = (): void => {
        const text = joint.slides ? `${this.q[k].toFixed(3)} m` : `${((180 * this.q[k]) / Math.PI).toFixed(1)}°`;
        if (readout.textContent === text) return;
        readout.textContent = text;
        slider.setAttribute("aria-valuetext", text);
      };
      slider.addEventListener("input", () => {
        this.q[k] = Number(slider.value);
        showValue();
        change([...this.q]);
      });
      slider.disabled = Boolean(fixed[k]);
      showValue();
      rows.push(h("label", { class: "view3d-joint" }, h("span", {}, fixed[k] || joint.name), slider, readout));
      return (value, enabled) => {
        if (Number(slider.value) !== value) slider.value = String(value);
        slider.disabled = !enabled;
        showValue();
      };
    });
    this.element = h("details", {}, h("summary", {}, "Move the joints"), ...rows);
  }

  /** Show a configuration, rad and m; joints that are not enabled cannot be moved. */
  update(q: ArrayLike<number>, enabled: boolean[]): void {
    this.q = Array.from(q);
    this.updates.forEach((update, k) => update(q[k], enabled[k]));
  }
}
