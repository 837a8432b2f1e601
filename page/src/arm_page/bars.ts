/** One bar for each joint: what remains if that joint locks. A click changes its condition. */

import { setText } from "../dom";
import type { Condition } from "./address";
import { fillText } from "./phrases";

export const NEXT_CONDITION: Record<Condition, Condition> = { healthy: "locked", locked: "free", free: "healthy" };

export interface BarValues {
  /** Length of each bar, from 0 to 1, and its text. */
  fractions: number[];
  texts: string[];
  worst: number;
  /** What a screen reader says after each text. */
  meaning: string;
}

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
      button.addEventListener("click", () => change(joint, NEXT_CONDITION[button.dataset.condition as Condition])),
    );
  }

  update({ fractions, texts, worst, meaning }: BarValues, conditions: Condition[]): void {
    this.buttons.forEach((button, joint) => {
      const condition = conditions[joint];
      button.dataset.condition = condition;
      button.dataset.worst = String(joint === worst);
      button.style.setProperty("--fraction", String(Math.min(fractions[joint], 1)));
      const state = condition === "healthy" ? (joint === worst ? this.texts.worst : "") : this.texts[condition];
      const next = fillText(meaning, { next: this.texts[`make_${NEXT_CONDITION[condition]}`] });
      for (const [name, text] of [["bar-value", texts[joint]], ["bar-condition", state], ["visually-hidden", next]]) {
        setText(button.querySelector(`.${name}`) as HTMLElement, text);
      }
    });
    this.list.dataset.failed = String(conditions.some((condition) => condition !== "healthy"));
  }
}
