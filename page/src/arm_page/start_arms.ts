/** Starts a page: its first arm at once, and another one when the menu chooses it. */

import type { Scene } from "../viewer/scene";
import type { ArmPage } from "./arm_page";
import type { ArmPageData, PrintedKernels } from "./data";
import type { StepClasses } from "./steps";

declare const armKernels: Record<string, PrintedKernels>;

type Section = HTMLElement & { armPage?: ArmPage };

type PageClass = new (...args: ConstructorParameters<typeof ArmPage<any>>) => ArmPage;

/** Start the arms of the document with a class of pages and its steps. */
export function startArms(pageClass: PageClass, steps: StepClasses): void {
  const sections = [...document.querySelectorAll<Section>(".arm")];
  const menu = document.querySelector<HTMLSelectElement>(".arm-menu");
  const show = (chosen: number): void => {
    sections.forEach((section, k) => (section.hidden = k !== chosen));
    if (sections[chosen]) startArm(sections[chosen], pageClass, steps);
  };
  menu?.addEventListener("change", () => show(menu.selectedIndex));
  const asked = new URLSearchParams(location.hash.slice(1)).get("arm");
  const first = Math.max(0, sections.findIndex((section) => section.dataset.name === asked));
  if (menu) menu.selectedIndex = first;
  show(first);
}

function startArm(section: Section, pageClass: PageClass, steps: StepClasses): void {
  const canvas = section.querySelector("canvas");
  const box = section.querySelector<HTMLElement>(".view3d");
  if (section.armPage || !canvas || !box) return;
  const read = (selector: string): unknown => JSON.parse(section.querySelector(selector)?.textContent ?? "");
  const scene = read(".view3d > script[type='application/json']") as Scene;
  scene.parts = read(".view3d-body script") as Scene["parts"];
  const data = { ...(read(".arm-data script") as ArmPageData), scene };
  section.armPage = new pageClass(section, data, armKernels[data.name], box, canvas, steps);
  section.armPage.start();
}
