/** A page to read, with buttons. */

import { button, card, h } from "../dom";
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
    const { testid, title, text, choices, figure } = page;
    const buttons = choices.map((c, i) => button(c.testid, c.label, () => resolve(c.testid), i ? "second" : "primary"));
    const properties = { class: figure ? "card wide with-figure" : "card", "data-testid": testid };
    element.replaceChildren(card("section", properties, title, text, figure, h("div", { class: "buttons" }, ...buttons)));
    buttons[0]?.focus({ preventScroll: true });
    if (!page.last) station.auto(() => buttons[0]?.click());
  });
}
