/** How was it? Keys 1 to 9, or a button. */

import { card, h } from "../dom";
import type { Station } from "../station";

/** @param suggestion what a dry run says, a step from 0; @returns the step */
export function showRating(element: HTMLElement, station: Station, suggestion: number): Promise<number> {
  const { texts, experiment } = station;
  return new Promise((resolve) => {
    const controller = new AbortController();
    const choose = (step: number): void => {
      controller.abort();
      resolve(step);
    };
    const buttons = experiment.rating.map((name, k) => {
      const properties = { type: "button", class: "second step", "data-testid": `rating-${k + 1}`, onclick: () => choose(k) };
      return h("button", properties, h("kbd", {}, String(k + 1)), h("span", {}, name));
    });
    const text = texts.get("rating_text", { count: buttons.length });
    const steps = h("div", { class: "steps" }, ...buttons);
    const properties = { class: "card wide", "data-testid": "rating" };
    element.replaceChildren(card("section", properties, texts.get("rating_title"), text, steps));
    const press = (event: KeyboardEvent): void => {
      const step = Number(event.key) - 1;
      if (!event.repeat && buttons[step] !== undefined) choose(step);
    };
    window.addEventListener("keydown", press, { signal: controller.signal });
    station.auto(() => choose(suggestion));
  });
}
