/** How was it? Keys 1 to 9, or a button. */

import { h } from "../dom";
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
    const buttons = experiment.rating.map((name, k) =>
      h(
        "button",
        { type: "button", class: "step", "data-testid": `rating-${k + 1}`, onclick: () => choose(k) },
        h("kbd", {}, String(k + 1)),
        h("span", {}, name),
      ),
    );
    element.replaceChildren(
      h(
        "section",
        { class: "card wide", "data-testid": "rating" },
        h("h1", {}, texts.get("rating_title")),
        h("div", { class: "prose" }, h("p", {}, texts.get("rating_text", { count: experiment.rating.length }))),
        h("div", { class: "steps" }, ...buttons),
      ),
    );
    window.addEventListener(
      "keydown",
      (event) => {
        const step = Number(event.key) - 1;
        if (!event.repeat && buttons[step] !== undefined) choose(step);
      },
      { signal: controller.signal },
    );
    station.auto(() => choose(suggestion));
  });
}
