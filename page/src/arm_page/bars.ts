/** One bar for each joint: the fraction of the motion that remains if that joint locks. A click changes its condition. */

import type { Condition } from "./address";
import { fillText, formatPercent } from "./phrases";

const NEXT: Record<Condition, Condition> = { healthy: "locked", locked: "free", free: "healthy" };

export class Bars {
  private readonly buttons: HTMLButtonElement[];

  /** The buttons exist, because Python has written them for a browser without script. */
  constructor(
    private readonly list: HTMLElement,
    private readonly texts: Record<string, string>,
    change: (joint: number, condition: Condition) => void,
  ) {
    this.buttons = [...list.querySelectorAll("button")];
    this.buttons.forEach((button, joint) =>
      button.addEventListener("click", () => change(joint, NEXT[button.dataset.condition as Condition])),
    );
  }

  /** Show the remaining fraction of each joint, the worst one, and the conditions. */
  update(fractions: number[], worst: number, conditions: Condition[]): void {
    this.buttons.forEach((button, joint) => {
      const condition = conditions[joint];
      const share = formatPercent(fractions[joint]);
      button.dataset.condition = condition;
      button.dataset.worst = String(joint === worst);
      button.style.setProperty("--fraction", String(Math.min(fractions[joint], 1)));
      (button.querySelector(".bar-value") as HTMLElement).textContent = share;
      (button.querySelector(".bar-condition") as HTMLElement).textContent =
        condition === "healthy" ? (joint === worst ? this.texts.worst : "") : this.texts[condition];
      const next = this.texts[`make_${NEXT[condition]}`];
      (button.querySelector(".visually-hidden") as HTMLElement).textContent = fillText(this.texts.bar, { next });
    });
    this.list.dataset.failed = String(conditions.some((condition) => condition !== "healthy"));
  }
}
