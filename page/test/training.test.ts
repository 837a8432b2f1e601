import { expect, test } from "vitest";
import { inARow, trained } from "../src/training";

const criterion = { at_least: 4, in_a_row: 2, limit: 55, most: 100 };

test("trained: enough in total, and the last in a row within the limit", () => {
  expect(trained(criterion, [60, 60, 55, 55])).toBe(true);
  expect(trained(criterion, [50, 50, 50])).toBe(false);
  expect(trained(criterion, [50, 50, 50, 56])).toBe(false);
});

test("a task that was not completed counts for nothing, and breaks the row", () => {
  expect(trained(criterion, [50, 50, null, 50, 50])).toBe(true);
  expect(trained(criterion, [50, 50, 50, null, 50])).toBe(false);
  expect(trained(criterion, [null, null, 50, 50])).toBe(false);
  expect(inARow(criterion, [50, null, 50, 50])).toBe(2);
  expect(inARow(criterion, [])).toBe(0);
});
