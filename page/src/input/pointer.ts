/** Mouse or finger as a stick: pressed and drawn away from the middle of a velocity window; it springs back when released. */

import type { View } from "../experiment";
import { REACH_FRACTION } from "../screens/windows";
import type { Device } from "./device";

export class Pointer implements Device {
  readonly kind = "pointer";
  /** Of each surface under a pointer: the deflection, along the view's two axes. */
  private readonly drawn = new Map<Element, { view: View; right: number; up: number }>();
  private controller = new AbortController();

  attach(surface: SVGElement, view: View): void {
    const { signal } = this.controller;
    const draw = (event: PointerEvent): void => {
      const box = surface.getBoundingClientRect();
      const reach = (REACH_FRACTION * Math.min(box.width, box.height)) / 2;
      const right = (event.clientX - box.left - box.width / 2) / reach;
      const up = (box.top + box.height / 2 - event.clientY) / reach;
      this.drawn.set(surface, { view, right: clamp(right), up: clamp(up) });
    };
    const letGo = (): void => void this.drawn.delete(surface);
    surface.classList.add("stick");
    const press = (event: PointerEvent): void => {
      surface.setPointerCapture(event.pointerId);
      draw(event);
    };
    surface.addEventListener("pointerdown", press, { signal });
    surface.addEventListener("pointermove", (event) => this.drawn.has(surface) && draw(event), { signal });
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) surface.addEventListener(name, letGo, { signal });
  }

  read(out: Float64Array): void {
    out.fill(0);
    for (const { view, right, up } of this.drawn.values()) {
      if (out.length < 3) {
        out[0] += right;
        if (out.length === 2) out[1] += up;
      } else {
        for (let i = 0; i < out.length; i++) out[i] += right * view.rows[0][i] + up * view.rows[1][i];
      }
    }
    for (let i = 0; i < out.length; i++) out[i] = clamp(out[i]);
  }

  detach(): void {
    this.controller.abort();
    this.controller = new AbortController();
    this.drawn.clear();
  }
}

function clamp(value: number): number {
  return Math.max(-1, Math.min(1, value));
}
