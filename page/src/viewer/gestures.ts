/** Pointers and keys that move the camera of a view. */

import type { View } from "./view";

/** Rotate, zoom, and move a view by pointers on its canvas and by keys; elements over the canvas keep their events. */
export function listenToPointers(view: View): void {
  const { canvas, camera } = view;
  const down = new Map<number, [number, number]>();
  let moved = 0;
  canvas.addEventListener("pointerdown", (event) => {
    down.set(event.pointerId, [event.clientX, event.clientY]);
    canvas.setPointerCapture(event.pointerId);
    moved = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = down.get(event.pointerId);
    if (!before) return;
    const [dx, dy] = [event.clientX - before[0], event.clientY - before[1]];
    moved += Math.abs(dx) + Math.abs(dy);
    const others = [...down].filter(([id]) => id !== event.pointerId).map(([, p]) => p);
    const tall = canvas.clientHeight;
    if (others.length) {
      const apart = (x: number, y: number): number => Math.hypot(x - others[0][0], y - others[0][1]) || 1;
      camera.zoom(apart(...before) / apart(event.clientX, event.clientY));
      camera.turn((2 * dx) / tall, (2 * dy) / tall);
    } else if (event.shiftKey || event.buttons & 6) {
      camera.pan(dx / tall, dy / tall);
    } else {
      camera.turn((4 * dx) / tall, (4 * dy) / tall);
    }
    down.set(event.pointerId, [event.clientX, event.clientY]);
    view.draw();
  });
  const up = (event: PointerEvent): void => {
    const { left, top } = canvas.getBoundingClientRect();
    if (down.delete(event.pointerId) && event.type === "pointerup" && moved < 4) {
      view.select(event.clientX - left, event.clientY - top);
    }
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener(
    "wheel",
    (event) => {
      // Scrolling the page past a view does not zoom it until the user has clicked the view.
      if (document.activeElement !== canvas && !event.ctrlKey) return;
      event.preventDefault();
      camera.zoom(Math.exp(0.0015 * event.deltaY));
      view.draw();
    },
    { passive: false },
  );
  const step = 0.1;
  const keys: Record<string, () => void> = {
    ArrowLeft: () => camera.turn(-step, 0),
    ArrowRight: () => camera.turn(step, 0),
    ArrowUp: () => camera.turn(0, step),
    ArrowDown: () => camera.turn(0, -step),
    "+": () => camera.zoom(0.9),
    "=": () => camera.zoom(0.9),
    "-": () => camera.zoom(1.1),
    "0": () => camera.reset(),
  };
  canvas.addEventListener("keydown", (event) => {
    const action = keys[event.key];
    if (!action || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    action();
    view.draw();
  });
}
