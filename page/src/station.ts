/** State that all screens share. */

import type { Arm } from "./arm";
import { Clock } from "./clock";
import { Connection } from "./connection";
import type { Device } from "./input/device";
import { FORMAT, type Done, type Hello, type Plan, type Welcome } from "./messages";
import { Outbox, type Body } from "./outbox";
import { Random } from "./random";
import { Frame } from "./screens/frame";
import { Stick } from "./stick";
import type { Storage } from "./storage";
import type { Experiment } from "./experiment";
import { sentence, Texts } from "./texts";

/** Progress of the session. */
export interface Progress extends Done {
  answered: Set<string>;
  /** The last trial has no rating yet. */
  unrated: boolean;
  /** True if the server expects nothing more. */
  over: boolean;
}

export class Station {
  readonly texts: Texts;
  readonly stick: Stick;
  readonly clock = new Clock();
  readonly frame: Frame;
  /** Simulated operator of a dry run; null with a person. */
  readonly robot: Random | null;
  device: Device | null = null;
  plan: Plan = { training: [], trials: [] };
  progress: Progress = { training: [], trials: 0, answered: new Set(), unrated: false, over: false };
  subject = "";
  private session: string | null = null;
  /** Identifier of a new session; it stays when hello is repeated, so that a lost answer creates no second subject. */
  private fresh = key();
  private readonly outbox: Outbox;
  private readonly connection: Connection;
  /** Time at which the connection was lost, ms. */
  private lostAt: number | null = null;
  /** Called when the session is over and all messages are sent. */
  private finished: (() => void) | null = null;
  /** The session cannot continue in this page. */
  private stopped = false;

  constructor(
    readonly experiment: Experiment,
    readonly arm: Arm,
    readonly storage: Storage,
    /** Addresses of the session, and of the page on which the next subject begins. */
    readonly addresses: { session: string; begin: string },
    readonly robotSeed: number | null,
    /** A session that this page was told to resume. */
    handed: string | null,
  ) {
    this.texts = new Texts(experiment.texts);
    this.stick = new Stick(experiment.stick.limit, experiment.stick.dead_zone);
    this.robot = robotSeed === null ? null : new Random(robotSeed);
    this.frame = new Frame(this.texts);
    const kept = storage.kept;
    this.session = handed ?? kept?.session ?? null;
    this.outbox = new Outbox(kept !== null && kept.session === this.session ? kept.outbox : []);
    this.connection = new Connection(addresses.session, this.outbox, {
      online: (yes) => this.online(yes),
      paused: (yes) => this.frame.set({ paused: yes }),
      unstored: (yes) => this.frame.set({ unstored: yes }),
      acknowledged: () => this.acknowledged(),
      over: (reason) => this.stop(reason),
    });
    window.addEventListener("pagehide", () => {
      this.keep();
      // Later messages would not be stored, and their numbers would be used again.
      this.connection.close();
    });
    // A page that the browser had put aside has lost its connection and its trial: begin anew.
    window.addEventListener("pageshow", (event) => event.persisted && location.reload());
  }

  /** Whether there is a session to resume. */
  get resumable(): boolean {
    return this.session !== null;
  }

  /** Forget the session of an earlier visit. */
  forget(): void {
    this.storage.kept = null;
    this.session = null;
    this.fresh = key();
    this.outbox.clear(0);
  }

  /** Take part: with the session of an earlier visit, or as a new subject. Rejected where the server refuses. */
  async join(code: string | null): Promise<void> {
    const kind = this.robot === null ? "person" : "simulated";
    const fresh = this.session === null ? this.fresh : null;
    const hello: Hello = { type: "hello", format: FORMAT, session: this.session, code, kind, fresh };
    const welcome = await this.connection.join(hello);
    this.take(welcome);
    this.keep();
  }

  send(body: Body): void {
    this.connection.send(body);
    this.frame.waiting(this.outbox.waiting.length);
  }

  event(kind: string, data: Record<string, string | number | boolean> = {}): void {
    this.send({ type: "event", kind, data });
  }

  answer(form: string, answers: Record<string, string | number | boolean>): void {
    this.progress.answered.add(form);
    this.send({ type: "answers", form, answers });
  }

  /** The session is over: nothing is kept for a later visit. Resolved when everything is on the server's disk. */
  finish(): Promise<void> {
    return new Promise((resolve) => {
      this.finished = resolve;
      this.acknowledged();
    });
  }

  /** In a dry run, do after a moment what a person would do. */
  auto(action: () => void, seconds = 0.25): void {
    if (this.robot !== null) setTimeout(action, 1000 * seconds);
  }

  private take(welcome: Welcome): void {
    this.session = welcome.session;
    this.subject = welcome.subject;
    this.plan = welcome.plan;
    const { done, unrated, over } = welcome;
    this.progress = { ...done, answered: new Set(welcome.answered), unrated, over };
    this.frame.subject(welcome.subject);
  }

  private online(yes: boolean): void {
    this.frame.online(yes, this.outbox.waiting.length);
    if (!yes && this.subject !== "") this.lostAt ??= performance.now();
    if (yes && this.lostAt !== null) {
      const seconds = (performance.now() - this.lostAt) / 1000;
      this.lostAt = null;
      this.event("offline", { seconds, waiting: this.outbox.waiting.length });
    }
  }

  private acknowledged(): void {
    this.frame.waiting(this.outbox.waiting.length);
    if (this.finished === null || this.outbox.waiting.length) return;
    this.storage.kept = null;
    this.finished();
  }

  private stop(reason: string | null): void {
    this.stopped = true;
    this.clock.stop();
    this.frame.set({ stopped: reason === null ? this.texts.get("elsewhere") : sentence(reason) });
  }

  private keep(): void {
    const outbox = [...this.outbox.waiting];
    // If another page continued the session, the stored data belong to that page.
    if (this.session === null || this.subject === "" || this.stopped) return;
    if (this.finished !== null && !outbox.length) return;
    this.storage.kept = { session: this.session, subject: this.subject, outbox };
  }
}

/** 24 random bytes, as the server takes them. */
function key(): string {
  return Array.from(crypto.getRandomValues(new Uint8Array(24)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}
