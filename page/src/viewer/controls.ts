/** Buttons and sliders under a picture. */

import { h } from "../dom";
import { Player } from "../player";
import type { Scene } from "./scene";
import type { View } from "./view";

/** Add the controls of a view to the page. */
export function addControls(view: View): void {
  const { box, scene } = view;
  const row = h("div", { class: "view3d-row" });
  if (scene.time.length) {
    const last = scene.time.length - 1;
    const format = (k: number): string => scene.readings[Math.round(k)] ?? `${scene.time[Math.round(k)].toPrecision(3)} s`;
    const texts = { play: "Play", pause: "Pause", time: "Time of the motion" };
    const player = new Player(texts, format, () => view.frame(player.time));
    player.input.step = "1";
    player.setRange(last, last / scene.seconds);
    player.showTime(0);
    row.append(player.button, player.input, player.readout);
  }
  row.append(...createViewButtons(view));
  box.querySelector(".view3d-controls")?.append(row);
  if (!scene.sliders) return;
  const labels = scene.joints.map(({ name }, k) => (scene.locked[k] === null ? name : `${name} (locked)`));
  const movable = scene.locked.map((time) => time === null);
  const show = (q: number[]): void => {
    view.pose(q);
    sliders.update(q, movable);
  };
  const [q] = view.configurations();
  const sliders = new JointSliders(scene, q, labels, show);
  sliders.update(q, movable);
  row.after(sliders.element);
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
  private q: number[] = [];
  private readonly rows: { input: HTMLInputElement; readout: HTMLOutputElement; slides: boolean }[];

  /** `change` is called with a configuration, rad and m, after a slider was moved from `q`. */
  constructor({ joints, size }: Scene, q: ArrayLike<number>, labels: string[], change: (q: number[]) => void) {
    this.rows = joints.map(({ slides, low, high }, k) => {
      const range = slides ? size : Math.PI;
      const [min, max] = [low ?? Math.min(-range, q[k]), high ?? Math.max(range, q[k])];
      const input = h("input", { type: "range", min, max, step: "any" });
      input.addEventListener("input", () => change(this.q.map((value, j) => (j === k ? input.valueAsNumber : value))));
      return { input, readout: h("output"), slides };
    });
    const labelled = this.rows.map(({ input, readout }, k) =>
      h("label", { class: "view3d-joint" }, h("span", {}, labels[k]), input, readout),
    );
    this.element = h("details", {}, h("summary", {}, "Move the joints"), ...labelled);
  }

  /** Show a configuration, rad and m; joints that are not enabled cannot be moved. */
  update(q: ArrayLike<number>, enabled: boolean[]): void {
    this.q = Array.from(q);
    this.rows.forEach(({ input, readout, slides }, k) => {
      input.disabled = !enabled[k];
      const text = slides ? `${q[k].toFixed(3)} m` : `${((180 * q[k]) / Math.PI).toFixed(1)}°`;
      if (input.valueAsNumber !== q[k]) input.value = String(q[k]);
      if (readout.textContent === text) return;
      readout.textContent = text;
      input.setAttribute("aria-valuetext", text);
    });
  }
}
