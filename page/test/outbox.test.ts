import { expect, test } from "vitest";
import { Outbox, type Body } from "../src/outbox";
import { Random } from "../src/random";

const cycle = (k: number): Body => ({ type: "cycles", first: k, time: [k], velocity: [[k, 0]], q: [[0, 0, k]] });
const seqs = (messages: readonly { seq: number }[]): number[] => messages.map((m) => m.seq);

test("messages are numbered from 1, sent once, and forgotten when acknowledged", () => {
  const box = new Outbox();
  box.push({ type: "begin", kind: "trial", position: 0 });
  box.push(cycle(0));
  expect(seqs(box.due())).toEqual([1, 2]);
  expect(box.due()).toEqual([]);
  box.acknowledged(1);
  expect(seqs(box.waiting)).toEqual([2]);
});

test("after a lost connection what the server has not is sent again, with the same numbers", () => {
  const box = new Outbox();
  for (let k = 0; k < 3; k++) {
    box.push(cycle(k));
    box.due();
  }
  expect(box.connected(1)).toBe(true);
  expect(seqs(box.due())).toEqual([2, 3]);
});

test("cycles that were never sent join one message; sent ones never change", () => {
  const box = new Outbox();
  box.push(cycle(0));
  box.due();
  for (let k = 1; k <= 300; k++) box.push(cycle(k));
  expect(box.waiting.map((m) => (m.type === "cycles" ? m.time.length : 0))).toEqual([1, 256, 44]);
  const copy = JSON.stringify(box.due());
  box.push(cycle(301));
  expect(box.connected(1)).toBe(true);
  expect(JSON.stringify(box.due().slice(0, 2))).toBe(
    JSON.stringify(JSON.parse(copy).filter((m: { seq: number }) => m.seq > 1)),
  );
});

test("cycles do not join over a gap or over another message", () => {
  const box = new Outbox();
  box.push(cycle(0));
  box.push(cycle(2));
  box.push({ type: "event", kind: "offline", data: {} });
  box.push(cycle(3));
  expect(box.waiting.length).toBe(4);
});

test("a restored outbox continues with its numbers and changes none of its messages", () => {
  const old = new Outbox();
  old.push(cycle(0));
  const box = new Outbox(JSON.parse(JSON.stringify(old.waiting)));
  box.push(cycle(1));
  expect(seqs(box.waiting)).toEqual([1, 2]);
  expect(box.connected(0)).toBe(true);
});

test("a server that is ahead, or behind, does not fit", () => {
  const box = new Outbox();
  box.clear(7);
  expect(box.connected(7)).toBe(true);
  expect(box.connected(9)).toBe(false);
  expect(box.connected(3)).toBe(false);
});

test("nothing is lost, doubled or out of order, however often the connection fails", () => {
  const random = new Random(11);
  for (let session = 0; session < 50; session++) {
    const box = new Outbox();
    const stored: number[] = [];
    let last = 0; // of the messages on the server
    let online = true;
    /** What is due arrives in order, until the connection breaks; the rest was sent for nothing. */
    const deliver = (chance: number): void => {
      for (const m of box.due()) {
        if (random.uniform() < chance) online = false;
        if (!online) return;
        if (m.seq !== ++last || m.type !== "cycles") throw new Error("out of order");
        stored.push(...m.time);
      }
      if (random.uniform() < 0.7) box.acknowledged(last);
    };
    for (let k = 0; k < 400; k++) {
      box.push(cycle(k));
      if (!online && random.uniform() < 0.1) online = box.connected(last);
      if (online) deliver(0.05);
    }
    online = box.connected(last);
    while (box.waiting.length) {
      deliver(0);
      box.acknowledged(last);
    }
    expect(stored).toEqual(Array.from({ length: 400 }, (_, k) => k));
  }
});
