/** What is around every screen: a line with progress and connection, and what covers the page while it is paused or over. */

import { h, paragraphs } from "../dom";
import type { Texts } from "../texts";

interface CoverState {
  /** The experimenter pauses the session; a trial under way continues. */
  paused: boolean;
  /** A trial is under way, or is being rated: no pause now. */
  occupied: boolean;
  /** The server cannot store anything: everything stops at once. */
  unstored: boolean;
  /** Reason why the session cannot continue in this page. */
  stopped: string | null;
}

export class Frame {
  /** Where the screens are shown, one after the other. */
  readonly stage = h("main", { id: "stage", "data-testid": "stage" });
  private readonly where = h("span", { class: "where", "data-testid": "progress" });
  private readonly who = h("span", { class: "who", "data-testid": "subject" });
  private readonly line = h("span", { class: "line", role: "status", "data-testid": "connection", "data-online": "none" });
  private readonly cover = h("div", { class: "cover", role: "alertdialog", "aria-live": "assertive", hidden: true });
  private state: CoverState = { paused: false, occupied: false, unstored: false, stopped: null };

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

  /** Whether a trial cannot begin now. */
  get isCovered(): boolean {
    return !this.cover.hidden;
  }

  get isUnstored(): boolean {
    return this.state.unstored;
  }

  /** Change the state of the session, and cover the page where it cannot continue. */
  set(changes: Partial<CoverState>): void {
    this.state = { ...this.state, ...changes };
    const { paused, occupied, unstored, stopped } = this.state;
    const key = stopped !== null ? "stopped" : unstored ? "unstored" : paused && !occupied ? "paused" : null;
    this.stage.inert = key !== null;
    this.cover.hidden = key === null;
    if (key === null) return;
    const title = h("h1", {}, this.texts.get(`${key}_title`));
    const text = paragraphs(stopped ?? this.texts.get(`${key}_text`));
    this.cover.replaceChildren(h("div", { class: "card", "data-testid": key }, title, ...text));
  }
}
