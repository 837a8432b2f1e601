/** Buttons and sliders under a picture. */

import { h } from "../dom";
import { Player } from "../player";
import type { Scene } from "./scene";
import type { View } from "./view";

/** Add the controls to the page; the returned function shows a frame of the motion. */
export function controls(view: View): (k: number) => void {
  const { box, scene } = view;
  const row = h("div", { class: "view3d-row" });
  const last = view.length - 1;
  const player = new Player({
    texts: { play: "Play", pause: "Pause", time: "Time of the motion" },
    show: () => view.frame(player.time),
    format: (k) => scene.readings[Math.round(k)] ?? `${scene.time[Math.round(k)].toPrecision(3)} s`,
  });
  player.input.step = "1";
  if (scene.time.length) {
    player.setRange(last, last / scene.seconds);
    player.setTime(0);
    row.append(player.button, player.input, player.readout);
  }
  row.append(...createViewButtons(view));
  const fixed = scene.joints.map((joint, k) => (scene.locked[k] === null ? "" : `${joint.name} (locked)`));
  const sliders = new JointSliders(scene, [...view.configurations()[0]], (q) => view.pose(q), fixed);
  box.querySelector(".view3d-controls")?.append(row, ...(scene.sliders ? [sliders.element] : []));
  return scene.time.length ? (k) => player.setTime(k) : () => undefined;
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
