/**
 * The connection to the server: all messages go through the outbox, a lost connection is reopened, and messages without an
 * acknowledgement are sent again. The page waits for the server only at the beginning.
 */

import { backoff } from "./backoff";
import type { FromPage, Hello, FromServer, Welcome } from "./messages";
import type { Body, Outbox } from "./outbox";

/** Time without an acknowledgement after which the connection counts as lost, ms. */
const SILENCE = 5000;

export interface Listener {
  /** Called when the connection is opened or lost. */
  online(yes: boolean): void;
  paused(yes: boolean): void;
  /** The server cannot store anything any more, or can again. */
  unstored(yes: boolean): void;
  /** Something more is on the server's disk. */
  acknowledged(): void;
  /** Called when the session cannot continue here; null if another page resumed it. */
  over(reason: string | null): void;
}

export class Connection {
  private socket: WebSocket | null = null;
  private hello: Hello | null = null;
  private joining: { resolve: (w: Welcome) => void; reject: (e: Error) => void } | null = null;
  private online = false;
  private closed = false;
  private tries = 0;
  private again: ReturnType<typeof setTimeout> | undefined;
  /** When the server was last heard, or had nothing to answer, ms. */
  private heard = 0;

  constructor(
    private readonly address: string,
    private readonly outbox: Outbox,
    private readonly listener: Listener,
  ) {
    window.addEventListener("online", () => this.hurry());
    window.addEventListener("offline", () => this.abandon());
    setInterval(() => this.watch(), 1000);
  }

  /** Say hello, and send what an earlier visit left behind; the server's welcome after that. Rejected when it refuses. */
  join(hello: Hello): Promise<Welcome> {
    this.hello = hello;
    return new Promise((resolve, reject) => {
      this.joining = { resolve, reject };
      this.connect();
    });
  }

  send(body: Body): void {
    if (!this.outbox.waiting.length) this.heard = performance.now();
    this.outbox.push(body);
    this.flush();
  }

  /** Nothing is sent any more. */
  close(): void {
    this.closed = true;
    this.leave();
  }

  private connect(): void {
    const socket = new WebSocket(this.address);
    this.socket = socket;
    this.heard = performance.now();
    socket.onopen = (): void => {
      if (this.hello !== null) this.put(this.hello);
    };
    socket.onmessage = (message: MessageEvent<string>): void => {
      if (this.socket === socket) this.take(JSON.parse(message.data) as FromServer);
    };
    socket.onclose = (): void => {
      if (this.socket === socket) this.abandon();
    };
  }

  /** The connection is lost, or as good as lost: try again in a while. */
  private abandon(): void {
    this.leave();
    if (this.closed || this.hello === null) return;
    clearTimeout(this.again);
    this.again = setTimeout(() => this.connect(), backoff(this.tries++, Math.random()) * 1000);
  }

  /** The network is back: try now. */
  private hurry(): void {
    if (this.socket !== null || this.closed || this.hello === null) return;
    clearTimeout(this.again);
    this.tries = 0;
    this.connect();
  }

  private watch(): void {
    const silent = performance.now() - this.heard > SILENCE;
    if (this.socket !== null && silent && (this.outbox.waiting.length || !this.online)) this.abandon();
  }

  private take(message: FromServer): void {
    this.heard = performance.now();
    switch (message.type) {
      case "welcome":
        return this.welcomed(message);
      case "ack":
        this.outbox.acknowledged(message.seq);
        this.flush();
        this.listener.acknowledged();
        if (this.joining && !this.outbox.waiting.length) this.ask();
        return;
      case "refused":
        return this.refused(message.seq, message.reason, message.last);
      case "pause":
        return this.listener.paused(message.paused);
      case "unstored":
        this.listener.unstored(true);
        return this.abandon();
      case "bye":
        return this.joining ? this.turnedAway(message.reason) : this.end(message.reason);
    }
  }

  private welcomed(welcome: Welcome): void {
    this.tries = 0;
    if (this.hello) this.hello = { ...this.hello, session: welcome.session };
    if (!this.outbox.connected(welcome.seq)) {
      // At the beginning: the messages of an earlier visit are already stored. Later: another page continued the session.
      if (!this.joining) return this.end(null);
      this.outbox.clear(welcome.seq);
    }
    this.report(true);
    this.listener.unstored(false);
    if (this.joining && !this.outbox.waiting.length) {
      this.joining.resolve(welcome);
      this.joining = null;
    }
    this.listener.paused(welcome.paused);
    this.flush();
  }

  private refused(seq: number | null, reason: string, last: number): void {
    if (seq !== null && seq <= last) {
      this.outbox.acknowledged(last);
      this.flush();
      this.listener.acknowledged();
    } else if (!this.joining) {
      this.end(reason);
    } else if (seq !== null) {
      // What an earlier visit left behind does not fit any more; it changed nothing.
      this.outbox.clear(last);
      this.ask();
    } else {
      this.turnedAway(reason);
    }
  }

  private turnedAway(reason: string): void {
    this.leave();
    this.hello = null;
    this.joining?.reject(new Error(reason));
    this.joining = null;
  }

  /** Ask again how far the session is. */
  private ask(): void {
    this.leave();
    this.connect();
  }

  private end(reason: string | null): void {
    this.close();
    this.listener.over(reason);
  }

  private leave(): void {
    const socket = this.socket;
    this.socket = null;
    socket?.close();
    this.report(false);
  }

  private flush(): void {
    if (!this.online || this.socket?.readyState !== WebSocket.OPEN) return;
    for (const message of this.outbox.due()) this.put(message);
  }

  private put(message: FromPage): void {
    this.socket?.send(JSON.stringify(message));
  }

  private report(online: boolean): void {
    if (online === this.online) return;
    this.online = online;
    this.listener.online(online);
  }
}
