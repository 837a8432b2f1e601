/** Who takes part: a new subject, with the laboratory's code if there is one, or the one who was here before. */

import { button, h, paragraphs } from "../dom";
import type { Station } from "../station";
import { sentence } from "../texts";

/** Resolved when the server has taken the person in. */
export function showJoin(element: HTMLElement, station: Station): Promise<void> {
  const { texts } = station;
  return new Promise((resolve) => {
    const code = h("input", {
      id: "code",
      "data-testid": "code",
      maxlength: 40,
      autocomplete: "off",
      spellcheck: "false",
      pattern: "[A-Za-z0-9][A-Za-z0-9_-]*",
    });
    const complaint = h("p", { class: "complaint", role: "alert", "data-testid": "join-refused" });
    const join = (): void => {
      const wanted = station.resumable ? null : code.value.trim() || null;
      for (const b of buttons) b.disabled = true;
      complaint.textContent = "";
      station.join(wanted).then(resolve, (error: Error) => {
        complaint.textContent = sentence(error.message);
        if (station.resumable) station.forget();
        show();
      });
    };
    const other = (): void => {
      station.forget();
      show();
    };
    let buttons: HTMLButtonElement[] = [];
    const show = (): void => {
      const back = station.resumable;
      const name = station.storage.kept?.subject ?? "";
      buttons = back
        ? [
            button("continue", texts.get("join_continue"), join),
            button("new-subject", texts.get("join_other"), other, "second"),
          ]
        : [button("join", texts.get("join_begin"), join)];
      const entry = h(
        "div",
        { class: "question" },
        h("label", { for: "code" }, texts.get("join_code")),
        code,
        h("p", { class: "help" }, texts.get("join_code_help")),
      );
      const body = h(
        "form",
        { class: "card", "data-testid": "join-screen" },
        h("h1", {}, texts.get("join_title")),
        h("div", { class: "prose" }, ...paragraphs(texts.get(back ? "join_back" : "join_text", { code: name }))),
        back ? null : entry,
        complaint,
        h("div", { class: "buttons" }, ...buttons),
      );
      body.addEventListener("submit", (event) => {
        event.preventDefault();
        join();
      });
      element.replaceChildren(body);
      (back ? buttons[0] : code).focus();
    };
    show();
    station.auto(join);
  });
}
