/** What is to be done, with a picture of the two windows as they are in a trial. */

import { h } from "../dom";
import type { Station } from "../station";
import { showPage } from "./page";
import { ArmWindows, VelocityWindows } from "./windows";

/** Of the stick, in the picture. */
const EXAMPLE = 0.7;

export async function showInstructions(element: HTMLElement, station: Station): Promise<void> {
  const { texts, plan, arm, device } = station;
  const next = [{ testid: "instructions-next", label: texts.get("go_on") }];
  const values = {
    start: texts.get(`start_${device?.kind ?? "keys"}`),
    steer: texts.get(`steer_${device?.kind ?? "keys"}`),
  };
  const views = station.experiment.views.length;
  const page = (part: number, more: string[], figure?: HTMLElement): Promise<string> => {
    const title = texts.get(`instructions_${part}_title`);
    const text = [`instructions_${part}_text`, ...more].map((key) => texts.get(key, values).trim()).join("\n\n");
    station.frame.progress(title);
    return showPage(element, station, { testid: `instructions-${part}`, title, text, choices: next, figure });
  };

  const task = plan.training[0] ?? { q0: [], target: [] };
  const start = new Float64Array(arm.axes);
  arm.position(Float64Array.from(task.q0), start);
  const arms = new ArmWindows(station);
  const velocities = new VelocityWindows(station);
  const way = task.target.map((v, i) => v - start[i]);
  const size = Math.hypot(...way) || 1;
  const command = way.map((v) => (EXAMPLE * station.stick.limit * v) / size);
  const more = [
    ...(station.experiment.reach === null ? [] : ["instructions_reach"]),
    ...(views > 1 ? ["instructions_views"] : []),
  ];
  const figure = h("div", { class: "figure", "data-views": views }, ...arms.elements, ...velocities.elements);
  const read = page(1, more, figure);
  arms.draw(task.q0, task);
  velocities.draw(command);
  await read;
  await page(2, []);
}
