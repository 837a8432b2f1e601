/** One subject: the present view of the subject, and the actions of the experimenter. */

import { button, h } from "../dom";
import { confirmed } from "./dialog";
import type { LiveView } from "./live";
import type { Cycle, Server, Subject } from "./server";
import { texts } from "./texts";

export class Panel {
  readonly element: HTMLElement;
  private subject: Subject | null = null;
  /** Of the note as the server has it. */
  private known = "";
  private readonly empty = h("p", { class: "none" }, texts.choose);
  private readonly title = h("h2", { "data-testid": "chosen" });
  private readonly details = h("p", { class: "help" });
  private readonly pause: HTMLButtonElement;
  private readonly handOver: HTMLButtonElement;
  private readonly drop: HTMLButtonElement;
  private readonly note = h("textarea", { id: "note", "data-testid": "note", rows: 2, maxlength: 10000 });
  private readonly said = h("p", { class: "said", role: "status", "data-testid": "said" });
  private readonly link = h("div", { class: "link", "data-testid": "resume-link", hidden: true });
  private readonly content: HTMLElement;

  constructor(
    private readonly server: Server,
    private readonly live: LiveView,
  ) {
    this.pause = button("pause-one", texts.pause, () => this.paused(), "second");
    this.handOver = button("resume", texts.handOver, () => void this.handedOver(), "second");
    this.handOver.title = texts.handOverHelp;
    this.drop = button("drop", texts.drop, () => void this.dropped(), "danger");
    const save = button("note-save", texts.save, () => this.saved(), "second");
    this.content = h(
      "div",
      { class: "content", hidden: true },
      h("div", { class: "heading" }, this.title, this.details),
      live.element,
      h("div", { class: "buttons" }, this.pause, this.handOver, this.drop, this.said),
      this.link,
      h("label", { for: "note" }, texts.note, h("span", { class: "help" }, ` ${texts.noteHelp}`)),
      h("div", { class: "entry" }, this.note, save),
    );
    this.element = h("section", { class: "panel", "data-testid": "panel" }, this.empty, this.content);
  }

  show(s: Subject | null, allPaused: boolean, cycle: Cycle | null, steering: boolean): void {
    const other = s?.subject !== this.subject?.subject;
    this.subject = s;
    this.empty.hidden = s !== null;
    this.content.hidden = s === null;
    if (s === null) return;
    if (other) {
      this.say("");
      this.link.hidden = true;
    }
    // A note that is being typed is not overwritten by updates.
    if (other || this.note.value === this.known) this.note.value = s.note;
    this.known = s.note;
    this.title.textContent = texts.subject(s.subject);
    const since = new Date(s.since).toLocaleString([], { dateStyle: "short", timeStyle: "short" });
    this.details.textContent = texts.details(s.row + 1, since);
    this.pause.textContent = s.paused ? texts.resume : texts.pause;
    this.pause.disabled = allPaused || s.state !== "open";
    this.handOver.disabled = s.state === "dropped";
    this.drop.disabled = s.state === "dropped";
    this.live.show(cycle, steering);
  }

  private paused(): void {
    const { subject, paused } = this.subject!;
    this.act(this.server.post("pause", { subject, paused: !paused }));
  }

  private saved(): void {
    const { subject } = this.subject!;
    const note = this.note.value;
    this.act(this.server.post("note", { subject, note }), () => {
      this.known = note;
      this.say(texts.saved);
    });
  }

  private async dropped(): Promise<void> {
    const { subject } = this.subject!;
    if (await confirmed(texts.dropTitle(subject), texts.dropText, texts.dropYes)) {
      this.act(this.server.post("drop", { subject }));
    }
  }

  private async handedOver(): Promise<void> {
    const { subject, connected } = this.subject!;
    if (connected && !(await confirmed(texts.handOverTitle(subject), texts.handOverText, texts.handOver))) return;
    this.act(this.server.post("resume", { subject }), ({ url }) => this.showLink(subject, url));
  }

  private showLink(subject: string, url: string): void {
    if (this.subject?.subject !== subject) return;
    const field = h("input", { id: "resume-url", "data-testid": "resume-url", type: "text", readonly: true, value: url });
    const copy = button("resume-copy", texts.copy, () => {
      field.select();
      void navigator.clipboard?.writeText(url).then(() => this.say(texts.copied));
    }, "second");
    this.link.replaceChildren(h("label", { for: "resume-url" }, texts.handedOver(subject)), h("div", { class: "entry" }, field, copy));
    this.link.hidden = false;
    field.select();
  }

  private act(done: Promise<Record<string, string>>, then: (answer: Record<string, string>) => void = () => {}): void {
    this.say("");
    done.then(then, (error: Error) => this.say(error.message, true));
  }

  private say(text: string, bad = false): void {
    this.said.textContent = text;
    this.said.dataset.bad = String(bad);
  }
}
