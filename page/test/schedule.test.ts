import { expect, test } from "vitest";
import { Frames, Schedule } from "../src/schedule";
import { Random } from "../src/random";

/** Cycles done at each wake-up. */
const wake = (schedule: Schedule, ...times: number[]): number[] => times.map((time) => schedule.wake(time));

test("one cycle for each wake-up on time, also where it jitters", () => {
  const schedule = new Schedule(100, 60);
  const random = new Random(3);
  for (let k = 0; k < 1000; k++) {
    const jitter = k ? (0.9 * random.uniform() - 0.2) / 60 : 0;
    expect(wake(schedule, 100 + k / 60 + jitter)).toEqual([1]);
  }
  expect(schedule.missed).toBe(0);
});

test("two wake-ups for one cycle do it once", () => {
  expect(wake(new Schedule(0, 10), 0, 0.001, 0.1, 0.101)).toEqual([1, 0, 1, 0]);
});

test("what a short hiccup left out is made up for, a long one is missed and reported", () => {
  const schedule = new Schedule(0, 60);
  expect(wake(schedule, 0, 5 / 60)).toEqual([1, 5]);
  expect(schedule).toMatchObject({ missed: 0, late: 1 });
  expect(wake(schedule, 65 / 60)).toEqual([6]);
  expect(schedule).toMatchObject({ missed: 54, late: 2 });
  expect(schedule.worst).toBeCloseTo(59 / 60, 12);
  expect(wake(schedule, 66 / 60)).toEqual([1]);
});

test("at six cycles a second nothing is made up for: the arm would leap", () => {
  const schedule = new Schedule(0, 6);
  expect(wake(schedule, 0, 0.6, 4 / 6)).toEqual([1, 1, 1]);
  expect(schedule.missed).toBe(2);
});

test("frames: the usual interval, and the slow ones", () => {
  const frames = new Frames();
  let t = 0;
  for (const interval of [0, 16, 17, 16, 50, 16]) frames.at((t += interval / 1000));
  expect(frames.summary()).toMatchObject({ frames: 5, slow: 1 });
  expect(frames.summary().worst).toBeCloseTo(0.05, 9);
  expect(new Frames().summary().frames).toBe(0);
});
