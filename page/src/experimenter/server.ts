/** Data from the server for the experimenter, and requests to the server. */

import { backoff } from "../backoff";
import type { Drawn } from "../screens/windows";
import { texts } from "./texts";

export interface Subject {
  subject: string;
  kind: "person" | "simulated" | "computer";
  state: "open" | "completed" | "dropped";
  /** UTC, ISO 8601. */
  since: string;
  note: string;
  /** From 0. */
  row: number;
  training: number;
  trials: number;
  /** Trials of a whole session. */
  of: number;
  connected: boolean;
  paused: boolean;
  /** Trials whose replay differs. */
  differing: number;
}

export interface State {
  /** True if all sessions are paused. */
  paused: boolean;
  /** Reason why nothing can be stored; null if storing works. */
  fault: string | null;
  subjects: Subject[];
}

/** Data that do not change while the server runs. */
export interface About {
  /** Name of the protocol. */
  name: string;
  folder: string;
  /** Address of a station. */
  station: string;
  scenarios: string[];
  joints: string[];
  /** Tasks of a session, for the windows. */
  plan: Drawn["plan"];
}

/** A control cycle of a trial under way. */
export interface Cycle {
  subject: string;
  kind: "training" | "trial";
  /** From 0; so is the scenario. */
  position: number;
  scenario: number;
  /** Number of cycles done. */
  cycle: number;
  q0: number[];
  q: number[];
  velocity: number[];
  target: number[];
  /** 0 for the locked joint, else 1. */
  healthy: number[];
}

type News = ({ type: "subjects" } & State) | ({ type: "cycle" } & Cycle);

export interface Watcher {
  online(yes: boolean): void;
  state(state: State): void;
  cycle(cycle: Cycle): void;
}

export class Server {
  private readonly key = new URLSearchParams(location.search).get("key") ?? "";
  private tries = 0;

  /** An address with the experimenter's key. */
  address(path: string, query: Record<string, string> = {}): string {
    const url = new URL(path, location.href);
    for (const [name, value] of Object.entries({ ...query, key: this.key })) url.searchParams.set(name, value);
    return url.href;
  }

  async about(): Promise<About & State> {
    const answer = await fetch(this.address("/experimenter/subjects.json"));
    if (!answer.ok) throw new Error(`${answer.status} ${answer.statusText}`);
    return (await answer.json()) as About & State;
  }

  /** Request an action; rejected with the reason of the server. */
  async post(what: "pause" | "note" | "drop" | "resume", body: object): Promise<Record<string, string>> {
    const headers = { "content-type": "application/json" };
    const request = { method: "POST", headers, body: JSON.stringify(body) };
    const answer = await fetch(this.address(`/experimenter/${what}`), request).catch(() => {
      throw new Error(texts.unreachable);
    });
    const said = (await answer.json().catch(() => ({}))) as Record<string, string>;
    if (!answer.ok) throw new Error(said.error ?? `${answer.status} ${answer.statusText}`);
    return said;
  }

  /** Receive updates from now on; a lost connection is reopened. */
  watch(watcher: Watcher): void {
    const socket = new WebSocket(this.address("/live").replace(/^http/, "ws"));
    socket.addEventListener("open", () => {
      this.tries = 0;
      watcher.online(true);
    });
    socket.addEventListener("message", (event) => {
      const news = JSON.parse(event.data as string) as News;
      if (news.type === "subjects") watcher.state(news);
      else watcher.cycle(news);
    });
    socket.addEventListener("close", () => {
      watcher.online(false);
      setTimeout(() => this.watch(watcher), 1000 * backoff(this.tries, Math.random()));
      this.tries += 1;
    });
  }
}
