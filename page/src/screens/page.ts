/** A page to read, with buttons. */

import { button, h, paragraphs } from "../dom";
import type { Station } from "../station";

export interface Choice {
  testid: string;
  label: string;
}

export interface Page {
  testid: string;
  title: string;
  text: string;
  /** The first is the main one. */
  choices: Choice[];
  /** A dry run stops here. */
  last?: boolean;
  /** Between text and buttons. */
  figure?: HTMLElement;
}

/** @returns which choice was made */
export function showPage(element: HTMLElement, station: Station, page: Page): Promise<string> {
  return new Promise((resolve) => {
    const buttons = page.choices.map((c, i) =>
      button(c.testid, c.label, () => resolve(c.testid), i ? "second" : "primary"),
    );
    const card = h(
      "section",
      { class: page.figure ? "card wide with-figure" : "card", "data-testid": page.testid },
      h("h1", {}, page.title),
      h("div", { class: "prose" }, ...paragraphs(page.text)),
      page.figure,
      h("div", { class: "buttons" }, ...buttons),
    );
    element.replaceChildren(card);
    buttons[0]?.focus({ preventScroll: true });
    if (!page.last) station.auto(() => buttons[0]?.click());
  });
}
