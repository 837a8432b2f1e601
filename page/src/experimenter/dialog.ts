/** A question that must be answered first. */

import { button, h } from "../dom";
import { texts } from "./texts";

export function confirmed(title: string, text: string, yes: string): Promise<boolean> {
  return new Promise((resolve) => {
    const close = (answer: boolean): void => {
      dialog.remove();
      resolve(answer);
    };
    const dialog = h(
      "dialog",
      { "data-testid": "confirm", "aria-labelledby": "question" },
      h("h1", { id: "question" }, title),
      h("p", {}, text),
      h(
        "div",
        { class: "buttons" },
        button("confirm-no", texts.cancel, () => close(false), "second"),
        button("confirm-yes", yes, () => close(true), "danger"),
      ),
    );
    dialog.addEventListener("cancel", () => close(false));
    document.body.append(dialog);
    dialog.showModal();
  });
}
