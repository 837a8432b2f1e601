import { expect, test } from "vitest";
import { norm, Stick } from "../src/stick";
import { Random } from "../src/random";

const stick = new Stick(0.05, 0.005);

function command(...deflection: number[]): number[] {
  const out = new Float64Array(deflection.length);
  stick.velocity(deflection, out);
  return Array.from(out);
}

test("a command is proportional to the deflection, and nothing is rescaled", () => {
  expect(command(0.5, 0)).toEqual([0.025, 0]);
  expect(command(0, -1)).toEqual([0, -0.05]);
});

test("slower commands than the dead zone are exactly none", () => {
  expect(command(0.07, 0.07).every((v) => v === 0)).toBe(true);
  expect(command(0.11, 0)).toEqual([0.05 * 0.11, 0]);
});

test("faster commands than the limit keep their direction", () => {
  const [x, y] = command(1, 1);
  expect(Math.hypot(x, y)).toBeCloseTo(0.05, 15);
  expect(x).toBe(y);
});

test("no command is beyond the limit by more than rounding, in any number of axes", () => {
  const random = new Random(1);
  for (let i = 0; i < 1000; i++) {
    const deflection = Array.from({ length: 1 + (i % 3) }, () => 2 * random.uniform() - 1);
    expect(norm(command(...deflection))).toBeLessThanOrEqual(0.05 * (1 + 1e-15));
  }
});
