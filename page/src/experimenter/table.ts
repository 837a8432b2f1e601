/** All subjects, one row each, in the order in which they came. Rows are changed in place: the focus stays where it is. */

import { button, h } from "../dom";
import type { Subject } from "./server";
import { texts } from "./texts";

/** Text about the present activity of a subject. */
function now(s: Subject, steering: boolean): string {
  if (s.state !== "open") return texts.states[s.state];
  return steering ? texts.steering : s.connected ? texts.connected : texts.notConnected;
}

class Row {
  readonly element: HTMLTableRowElement;
  readonly button: HTMLButtonElement;
  private readonly kind = h("span", { class: "kind" });
  private readonly now = h("span", { class: "now" });
  private readonly paused = h("span", { class: "paused" }, texts.paused);
  private readonly training = h("td", { class: "number" });
  private readonly bar = h("progress", { "aria-hidden": "true" });
  private readonly trials = h("span", {});
  private readonly replay = h("td", { class: "replay", title: texts.differsHelp });
  private readonly row = h("td", { class: "number" });
  private readonly note = h("td", { class: "note" });

  constructor(code: string, choose: (code: string) => void) {
    this.button = button(`subject-${code}`, code, () => choose(code), "second code");
    const head = h("th", { scope: "row" }, this.button, this.kind);
    const state = h("td", { class: "state" }, this.now, this.paused);
    const trials = h("td", { class: "trials" }, this.bar, this.trials);
    this.element = h("tr", { "data-testid": `row-${code}` }, head, state, this.training, trials, this.replay, this.row, this.note);
    this.element.addEventListener("click", (event) => event.target !== this.button && choose(code));
  }

  show(s: Subject, steering: boolean, chosen: boolean): void {
    const { state, connected, paused, differing } = s;
    Object.assign(this.element.dataset, { state, connected, steering, paused, differing, chosen });
    this.button.setAttribute("aria-pressed", String(chosen));
    this.kind.textContent = s.kind === "person" ? "" : texts.simulated;
    this.now.textContent = now(s, steering);
    this.paused.hidden = !s.paused || s.state !== "open";
    this.training.textContent = String(s.training);
    this.bar.max = s.of;
    this.bar.value = s.trials;
    this.trials.textContent = texts.progress(s.trials, s.of);
    this.replay.textContent = s.differing ? `\u26a0 ${texts.differs(s.differing)}` : texts.same;
    this.row.textContent = String(s.row + 1);
    this.note.textContent = s.note.split("\n")[0];
    this.note.title = s.note;
  }
}

export class Table {
  readonly element: HTMLElement;
  private readonly rows = new Map<string, Row>();
  private readonly body = h("tbody", {});
  private readonly none = h("p", { class: "none" }, texts.noSubjects);

  constructor(private readonly choose: (code: string) => void) {
    const head = h("tr", {}, ...texts.columns.map((name) => h("th", { scope: "col" }, name)));
    const table = h("table", { "data-testid": "subjects" }, h("thead", {}, head), this.body);
    this.element = h("section", { class: "subjects" }, table, this.none);
  }

  show(subjects: Subject[], steering: (code: string) => boolean, chosen: string | null): void {
    this.none.hidden = subjects.length > 0;
    const there = new Set(subjects.map((s) => s.subject));
    for (const [code, row] of this.rows) {
      if (there.has(code)) continue;
      row.element.remove();
      this.rows.delete(code);
    }
    for (const s of subjects) {
      const row = this.rows.get(s.subject) ?? new Row(s.subject, this.choose);
      if (!row.element.isConnected) this.body.append(row.element);
      this.rows.set(s.subject, row);
      row.show(s, steering(s.subject), s.subject === chosen);
    }
  }
}
