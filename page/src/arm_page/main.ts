/** Starts the page of an arm: its first arm at once, and another one when the menu chooses it. */

import type { Scene } from "../viewer/scene";
import { ArmPage } from "./arm_page";
import type { ArmPageData, PrintedKernels } from "./data";

declare const armKernels: Record<string, PrintedKernels>;

type Section = HTMLElement & { armPage?: ArmPage };

function start(section: Section): void {
  const canvas = section.querySelector("canvas");
  const box = section.querySelector<HTMLElement>(".view3d");
  if (section.armPage || !canvas || !box) return;
  const read = (selector: string): unknown => JSON.parse(section.querySelector(selector)?.textContent ?? "");
  const scene = read(".view3d > script[type='application/json']") as Scene;
  scene.parts = read(".view3d-body script") as Scene["parts"];
  const data = { ...(read(".arm-data script") as ArmPageData), scene };
  section.armPage = new ArmPage(section, data, armKernels[data.name], box, canvas);
}

const sections = [...document.querySelectorAll<Section>(".arm")];
const menu = document.querySelector<HTMLSelectElement>(".arm-menu");
menu?.addEventListener("change", () => {
  sections.forEach((section, k) => (section.hidden = k !== menu.selectedIndex));
  start(sections[menu.selectedIndex]);
});
const asked = new URLSearchParams(location.hash.slice(1)).get("arm");
const first = Math.max(0, sections.findIndex((section) => section.dataset.name === asked));
if (menu) menu.selectedIndex = first;
sections.forEach((section, k) => (section.hidden = k !== first));
if (sections.length) start(sections[first]);
performance.mark("arm page ready");
