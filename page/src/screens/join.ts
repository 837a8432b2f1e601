/** Who takes part: a new subject, with the laboratory's code if there is one, or the one who was here before. */

import { button, card, h } from "../dom";
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
    const help = h("p", { class: "help" }, texts.get("join_code_help"));
    const entry = h("div", { class: "question" }, h("label", { for: "code" }, texts.get("join_code")), code, help);
    const complaint = h("p", { class: "complaint", role: "alert", "data-testid": "join-refused" });
    let buttons: HTMLButtonElement[] = [];
    const forget = (): void => {
      station.forget();
      show();
    };
    const join = (): void => {
      for (const b of buttons) b.disabled = true;
      complaint.textContent = "";
      station.join(station.resumable ? null : code.value.trim() || null).then(resolve, (error: Error) => {
        complaint.textContent = sentence(error.message);
        if (station.resumable) forget();
        else show();
      });
    };
    const show = (): void => {
      const back = station.resumable;
      const resume = button("continue", texts.get("join_continue"), join);
      const other = button("new-subject", texts.get("join_other"), forget, "second");
      buttons = back ? [resume, other] : [button("join", texts.get("join_begin"), join)];
      const text = texts.get(back ? "join_back" : "join_text", { code: station.storage.kept?.subject ?? "" });
      const properties = { class: "card", "data-testid": "join-screen" };
      const choices = h("div", { class: "buttons" }, ...buttons);
      const body = card("form", properties, texts.get("join_title"), text, back ? null : entry, complaint, choices);
      body.onsubmit = (event): void => {
        event.preventDefault();
        join();
      };
      element.replaceChildren(body);
      (back ? buttons[0] : code).focus();
    };
    show();
    station.auto(join);
  });
}
