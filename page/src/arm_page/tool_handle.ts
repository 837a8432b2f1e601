/** The ring at the tool: a button that is dragged by pointer or moved by keys. */

import type { Vector } from "../viewer/scene";

export interface HandleActions {
  /** Move the target of the tool to a displacement from where the drag began, in pixels to the right and downward. */
  drag: (right: number, down: number) => void;
  /** Move the target by a step: to the right, upward, and along gravity, in steps. */
  step: (right: number, up: number, gravity: number) => void;
  begin: () => void;
  end: () => void;
}

const COARSE_STEPS = 4; // small steps of a key without Shift

export class ToolHandle {
  private start: { pointer: number; x: number; y: number } | null = null;

  constructor(
    readonly button: HTMLButtonElement,
    private readonly actions: HandleActions,
  ) {
    button.addEventListener("pointerdown", (event) => this.press(event));
    button.addEventListener("pointermove", (event) => this.move(event));
    for (const type of ["pointerup", "pointercancel", "lostpointercapture"] as const) {
      button.addEventListener(type, (event) => this.release(event));
    }
    button.addEventListener("keydown", (event) => this.key(event));
    button.addEventListener("keyup", (event) => {
      if (event.key in KEYS) actions.end();
    });
  }

  get dragging(): boolean {
    return this.start !== null;
  }

  /** Place the ring at a point of the picture, CSS pixels. */
  place([x, y]: Vector | [number, number]): void {
    this.button.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
  }

  private press(event: PointerEvent): void {
    if (this.start) return; // a second finger does not take over
    this.start = { pointer: event.pointerId, x: event.clientX, y: event.clientY };
    this.button.setPointerCapture(event.pointerId);
    this.actions.begin();
  }

  private move(event: PointerEvent): void {
    if (this.start?.pointer !== event.pointerId) return;
    this.actions.drag(event.clientX - this.start.x, event.clientY - this.start.y);
  }

  private release(event: PointerEvent): void {
    if (this.start?.pointer !== event.pointerId) return;
    this.start = null;
    this.actions.end();
  }

  private key(event: KeyboardEvent): void {
    const direction = KEYS[event.key];
    if (!direction || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    const steps = event.shiftKey ? 1 : COARSE_STEPS;
    this.actions.step(steps * direction[0], steps * direction[1], steps * direction[2]);
  }
}

/** To the right, upward on the picture, and along gravity. */
const KEYS: Record<string, Vector> = {
  ArrowLeft: [-1, 0, 0],
  ArrowRight: [1, 0, 0],
  ArrowUp: [0, 1, 0],
  ArrowDown: [0, -1, 0],
  PageUp: [0, 0, -1],
  PageDown: [0, 0, 1],
};
