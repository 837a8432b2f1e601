import { expect, test } from "vitest";
import { deflection, standard } from "../src/input/calibration";
import { Wizard } from "../src/screens/wizard";

const read = (calibration: Parameters<typeof deflection>[0], raw: number[]): number[] => {
  const out = new Float64Array(calibration.axes.length);
  deflection(calibration, raw, out);
  return Array.from(out);
};

test("the standard layout: to the right is positive, forward is up", () => {
  expect(read(standard(2), [0.5, -0.25, 0, 0])).toEqual([0.5, 0.25]);
  expect(read(standard(3), [0, 0, 0, -1])[2]).toBe(1);
});

test("an axis that the gamepad lacks does not deflect", () => {
  expect(read(standard(3), [0, 0])).toEqual([0, 0, 0]);
});

test("the wizard finds axes, directions, rest and range, and the button", () => {
  // The stick's axes are 2 and 5 of the device, the first one reversed; it rests off the middle and trembles.
  const tremble = (i: number): number => (i % 2 ? 0.01 : -0.01);
  const raw = (right: number, up: number, i: number): number[] => [0, 0, 0.1 - 0.8 * right + tremble(i), 0, 0, -0.05 - 0.9 * up, 0];
  const wizard = new Wizard(2);
  let now = 0;
  const hold = (right: number, up: number, seconds: number, button = -1): string => {
    let said = "";
    for (let i = 0; i < seconds * 60; i++) {
      now += 1 / 60;
      const buttons = Array.from({ length: 12 }, (_, k) => k === button);
      said = wizard.look(raw(right, up, i), buttons, now);
      if (wizard.result) break;
    }
    return said;
  };
  expect(hold(0, 0, 1)).toBe("calibrate_rest");
  expect(hold(0, 0, 1)).toBe("calibrate_axis_1");
  hold(1, 0, 1);
  expect(hold(1, 0, 0.1)).toBe("calibrate_let_go");
  expect(hold(0, 0, 0.2)).toBe("calibrate_axis_2");
  hold(0, 1, 1);
  expect(hold(0, 0, 0.2)).toBe("calibrate_button");
  hold(0, 0, 0.2, 3);
  const found = wizard.result;
  if (found === null) throw new Error("nothing was found");
  expect(found.axes.map((a) => a.axis)).toEqual([2, 5]);
  expect(found.start).toEqual([3]);
  expect(read(found, raw(0, 0, 0))).toEqual([0, 0]);
  const [x, y] = read(found, raw(0.5, -0.5, 0));
  expect(x).toBeCloseTo(0.5, 1);
  expect(y).toBeCloseTo(-0.5, 1);
  expect(read(found, raw(1, 1, 1)).every((v) => v > 0.97 && v <= 1)).toBe(true);
});
