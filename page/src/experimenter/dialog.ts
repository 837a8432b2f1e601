/** A question that must be answered first. */

import { button, h } from "../dom";
import { texts } from "./texts";

export function confirmed(title: string, text: string, yes: string): Promise<boolean> {
  return new Promise((resolve) => {
    const cancel = button("confirm-no", texts.cancel, () => dialog.close(), "second");
    const confirm = button("confirm-yes", yes, () => dialog.close("yes"), "danger");
    const buttons = h("div", { class: "buttons" }, cancel, confirm);
    const properties = { "data-testid": "confirm", "aria-labelledby": "question" };
    const dialog = h("dialog", properties, h("h1", { id: "question" }, title), h("p", {}, text), buttons);
    // Closed first, then removed: the focus goes back to where it was.
    dialog.addEventListener("close", () => {
      dialog.remove();
      resolve(dialog.returnValue === "yes");
    });
    document.body.append(dialog);
    dialog.showModal();
  });
}
