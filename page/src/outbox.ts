/**
 * Messages that are not yet on the server's disk, in order. Each has a number, counted per session; a message that was sent
 * once keeps its number and its content, so that the server recognises it if it is sent again after a lost connection.
 */

import { MOST_CYCLES, type FromPage, type Hello } from "./messages";

export type Numbered = Exclude<FromPage, Hello>;
type Unnumbered<M> = M extends Numbered ? Omit<M, "seq"> : never;
export type Body = Unnumbered<Numbered>;

/** Largest number of messages in flight; later messages wait, and waiting cycles are merged. */
const WINDOW = 64;

export class Outbox {
  private queue: Numbered[];
  private next: number;
  /** Messages up to this number were sent at least once, on any connection. */
  private touched: number;
  /** Messages up to this number were sent on this connection. */
  private sent = 0;

  constructor(queue: Numbered[] = []) {
    this.queue = queue;
    this.touched = queue.at(-1)?.seq ?? 0;
    this.next = this.touched + 1;
  }

  get waiting(): readonly Numbered[] {
    return this.queue;
  }

  push(body: Body): void {
    if (body.type !== "cycles" || !this.appended(body)) this.queue.push({ ...body, seq: this.next++ } as Numbered);
  }

  /** Return the messages to send now. */
  due(): Numbered[] {
    const found = this.queue.slice(0, WINDOW).filter((m) => m.seq > this.sent);
    this.sent = found.at(-1)?.seq ?? this.sent;
    this.touched = Math.max(this.touched, this.sent);
    return found;
  }

  /** Note that all messages up to a number are on the disk. */
  acknowledged(seq: number): void {
    this.queue = this.queue.filter((m) => m.seq > seq);
  }

  /**
   * A new connection, with a server that has everything up to `last`.
   *
   * @returns false if the record and this queue do not fit, because another page continued the session or the record is older
   */
  connected(last: number): boolean {
    this.acknowledged(last);
    this.sent = last;
    return last === (this.queue[0]?.seq ?? this.next) - 1;
  }

  /** Discard the waiting messages; the session continues after `last`. */
  clear(last: number): void {
    this.queue = [];
    this.next = last + 1;
    this.touched = this.sent = last;
  }

  /** Add cycles to the last message if it was never sent. */
  private appended(body: Extract<Body, { type: "cycles" }>): boolean {
    const last = this.queue.at(-1);
    if (last?.type !== "cycles" || last.seq <= this.touched) return false;
    if (last.first + last.time.length !== body.first || last.time.length + body.time.length > MOST_CYCLES) return false;
    last.time.push(...body.time);
    last.velocity.push(...body.velocity);
    last.q.push(...body.q);
    return true;
  }
}
