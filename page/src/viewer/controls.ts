/** Buttons and sliders under a picture. */

import { h } from "../dom";
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
  const reset = h("button", { type: "button" }, "Reset the view");
  reset.addEventListener("click", () => {
    view.camera.reset();
    view.draw();
  });
  const names = h("button", { type: "button", "aria-pressed": "false" }, "Names");
  names.addEventListener("click", () => {
    view.names = !view.names;
    names.setAttribute("aria-pressed", String(view.names));
    view.draw();
  });
  row.append(reset, names);
  box.querySelector(".view3d-controls")?.append(row, ...(scene.sliders ? [joints(view)] : []));
  return (k) => shown(k);
}

/** A slider for each joint; one without limits goes once round. */
function joints(view: View): HTMLElement {
  const { scene } = view;
  const q = [...view.configurations()[0]];
  const rows = scene.joints.map((joint, k) => {
    const free = joint.slides ? scene.size : Math.PI;
    const [low, high] = [joint.low ?? Math.min(-free, q[k]), joint.high ?? Math.max(free, q[k])];
    const words = (): string => (joint.slides ? `${q[k].toFixed(3)} m` : `${((180 * q[k]) / Math.PI).toFixed(1)}°`);
    const slider = h("input", { type: "range", min: low, max: high, step: "any", value: q[k], "aria-valuetext": words() });
    const said = h("output", {}, words());
    slider.addEventListener("input", () => {
      q[k] = Number(slider.value);
      said.textContent = words();
      slider.setAttribute("aria-valuetext", words());
      view.pose([...q]);
    });
    slider.disabled = scene.locked[k] !== null;
    const name = scene.locked[k] === null ? joint.name : `${joint.name} (locked)`;
    return h("label", { class: "view3d-joint" }, h("span", {}, name), slider, said);
  });
  return h("details", {}, h("summary", {}, "Move the joints"), ...rows);
}
