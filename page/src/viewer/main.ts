/** Replaces the static pictures of a page by views that can be rotated, if the browser has a canvas. */

import { addControls } from "./controls";
import type { Scene } from "./scene";
import { View } from "./view";

type Box = HTMLElement & { view3d?: View };

for (const box of document.querySelectorAll<Box>(".view3d")) {
  const canvas = box.querySelector("canvas");
  const data = box.querySelector("script[type='application/json']");
  if (box.view3d || !canvas || !data) continue;
  const hint = box.querySelector<HTMLElement>(".view3d-hint");
  try {
    const scene = JSON.parse(data.textContent ?? "") as Scene & { parts: unknown };
    // Views of the same body share it.
    const body = document.querySelector(`.view3d-body[data-key="${scene.parts}"] script`);
    scene.parts = JSON.parse(body?.textContent ?? "") as Scene["parts"];
    box.view3d = new View(box, canvas, scene);
    addControls(box.view3d);
    if (hint) {
      hint.textContent = "Drag or use the arrow keys to rotate, + and - or the wheel to zoom, and 0 to reset. Shift and drag to move.";
    }
  } catch {
    if (hint) hint.textContent = "The view cannot be rotated, because this browser cannot draw on a canvas.";
  }
}
