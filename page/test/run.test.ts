import { expect, test } from "vitest";
import { Run, type Task } from "../src/run";
import { Stick } from "../src/stick";
import { slides } from "./toy";

const stick = new Stick(0.05, 0.005);
const task: Task = { law: 0, q0: [0, 0], target: [0.2, 0], joint: -1 };
const run = (cycleLimit: number | null = null, over: Partial<Task> = {}): Run =>
  new Run(slides, { ...task, ...over }, stick, { radius: 0.1, cycle_limit: cycleLimit });

test("a trial ends by stopping inside the circle, not by passing through it", () => {
  const r = run();
  for (let k = 0; k < 3; k++) expect(r.step([1, 0], false)).toBeNull();
  expect(r.inside).toBe(true);
  expect(r.step([1, 0], false)).toBeNull();
  expect(r.step([0.05, 0], false)).toBe("arrived");
  expect(r.cycles).toBe(4);
});

test("resting outside ends nothing, and is recorded as cycles", () => {
  const r = run();
  for (let k = 0; k < 20; k++) expect(r.step([0, 0], false)).toBeNull();
  expect(r.cycles).toBe(20);
});

test("a start inside the circle and at rest is over before the first cycle", () => {
  expect(run(null, { q0: [0.15, 0] }).step([0, 0], false)).toBe("arrived");
});

test("giving up goes before reaching the target, and that before the limit of cycles", () => {
  const r = run(3);
  for (let k = 0; k < 3; k++) r.step([1, 0], false);
  expect(r.step([1, 0], false)).toBe("time");
  expect(r.step([0, 0], false)).toBe("arrived");
  expect(r.step([0, 0], true)).toBe("aborted");
  expect(r.cycles).toBe(3);
});

test("what is recorded is the command after the stick and the configuration when the cycle began", () => {
  const r = run();
  r.step([1, 0], false);
  r.step([0, 1], false);
  expect(Array.from(r.before)).toEqual([0.05, 0]);
  expect(Array.from(r.velocity)).toEqual([0, 0.05]);
  expect(Array.from(r.q)).toEqual([0.05, 0.05]);
});

test("a locked joint is still, and each scenario has its law", () => {
  const locked = run(null, { joint: 0 });
  locked.step([1, 1], false);
  expect(locked.q[0]).toBe(0);
  expect(locked.q[1]).toBeGreaterThan(0);
  const slow = run(null, { law: 1 });
  slow.step([1, 0], false);
  expect(slow.q[0]).toBe(0.025);
});
