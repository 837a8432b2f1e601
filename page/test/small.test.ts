import { expect, test } from "vitest";
import { backoff } from "../src/backoff";
import type { View } from "../src/experiment";
import { projectPoint, projectTask } from "../src/projection";
import { sentence, Texts } from "../src/texts";

test("waiting between tries grows, within bounds, and is spread", () => {
  expect(backoff(0, 0.5)).toBe(0.25);
  expect(backoff(3, 0.5)).toBe(2);
  expect(backoff(50, 0.5)).toBe(5);
  expect(backoff(50, 1)).toBeLessThan(7);
});

test("texts: values take the place of braces, other braces stay", () => {
  const texts = new Texts({ a: "{n} of {m}", b: "plain" });
  expect(texts.get("a", { n: 1 })).toBe("1 of {m}");
  expect(texts.get("b")).toBe("plain");
  expect(texts.get("no_such_key")).toBe("no_such_key");
});

test("the server's reasons become sentences", () => {
  expect(sentence("the session has moved to another page")).toBe("The session has moved to another page.");
  expect(sentence("Done.")).toBe("Done.");
});

test("a view from the side shows x to the right and z upwards", () => {
  const side: View = { label: "x, z", rows: [[1, 0, 0], [0, 0, 1]] };
  expect(projectPoint(side, [9, 9, 9, 1, 2, 3], 3)).toEqual([1, 3]);
  expect(projectTask(side, [1, 2, 3])).toEqual([1, 3]);
  expect(projectTask(side, [1, 2])).toEqual([1, 2]);
});
