/** What is around every screen: a line with progress and connection, and what covers the page while it is paused or over. */

import { h, paragraphs } from "../dom";
import type { Texts } from "../texts";

export class Frame {
  /** Where the screens are shown, one after the other. */
  readonly stage = h("main", { id: "stage", "data-testid": "stage" });
  private readonly where = h("span", { class: "where", "data-testid": "progress" });
  private readonly who = h("span", { class: "who", "data-testid": "subject" });
  private readonly line = h("span", { class: "line", role: "status", "data-testid": "connection", "data-online": "none" });
  private readonly cover = h("div", { class: "cover", role: "alertdialog", "aria-live": "assertive", hidden: true });
  private paused = false;
  private busy = false;
  /** True if the server cannot store anything. */
  isUnstored = false;
  /** Reason why the session cannot continue in this page; null if it can. */
  private reason: string | null = null;

  constructor(private readonly texts: Texts) {
    document.documentElement.lang = texts.get("language");
    document.title = texts.get("title");
    const top = h("header", {}, h("span", { class: "name" }, texts.get("title")), this.where, this.who, this.line);
    document.getElementById("app")?.replaceChildren(top, this.stage, this.cover);
  }

  progress(text: string): void {
    this.where.textContent = text;
  }

  subject(code: string): void {
    this.who.textContent = this.texts.get("subject", { code });
  }

  online(yes: boolean, waiting: number): void {
    this.line.dataset.online = String(yes);
    this.line.textContent = yes ? this.texts.get("online") : this.texts.get("offline", { waiting });
  }

  waiting(count: number): void {
    this.line.dataset.waiting = String(count);
    if (this.line.dataset.online === "false") this.line.textContent = this.texts.get("offline", { waiting: count });
  }

  /** The experimenter pauses the session; a trial under way continues. */
  pause(yes: boolean): void {
    this.paused = yes;
    this.update();
  }

  /** The server cannot store anything any more, or can again: everything stops at once, or resumes. */
  unstored(yes: boolean): void {
    this.isUnstored = yes;
    this.update();
  }

  /** A trial is under way, or is being rated: no pause now. */
  set occupied(yes: boolean) {
    this.busy = yes;
    this.update();
  }

  get isPaused(): boolean {
    return this.paused && !this.busy;
  }

  /** The session cannot continue in this page. */
  stop(reason: string): void {
    this.reason = reason;
    this.update();
  }

  private update(): void {
    const key = this.reason !== null ? "stopped" : this.isUnstored ? "unstored" : this.isPaused ? "paused" : null;
    this.stage.inert = key !== null;
    this.cover.hidden = key === null;
    if (key === null) return;
    const title = h("h1", {}, this.texts.get(`${key}_title`));
    const text = paragraphs(this.reason ?? this.texts.get(`${key}_text`));
    this.cover.replaceChildren(h("div", { class: "card", "data-testid": key }, title, ...text));
  }
}
