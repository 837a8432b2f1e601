import { expect, test } from "vitest";
import { Robot } from "../src/input/robot";
import { Run } from "../src/run";
import { Stick } from "../src/stick";
import { slides } from "./toy";

/** Cycles that the robot needs for a task, and how it ends. */
function cycles(seed: number, rate: number): number {
  const limit = 0.3 / rate;
  const robot = new Robot(seed, 2, limit, rate, 0.1);
  const target = [1.2, -0.9];
  const rules = { radius: 0.1, cycle_limit: null };
  const run = new Run(slides, { law: 0, q0: [0, 0], target, joint: -1 }, new Stick(limit, limit / 10), rules);
  const deflection = new Float64Array(2);
  robot.begin();
  for (let k = 0; k < 60 * rate; k++) {
    robot.see({ cycle: run.cycles, x: run.x, target });
    robot.read(deflection);
    const end = run.step(deflection, robot.tired);
    if (end !== null) {
      expect(end).toBe("arrived");
      return run.cycles;
    }
  }
  throw new Error("the robot did not reach the target");
}

test("the robot reaches the target, slower than straight at full speed, and the same way for a seed", () => {
  for (const rate of [6, 60]) {
    for (let seed = 0; seed < 20; seed++) {
      const ideal = ((1.5 - 0.1) / 0.3) * rate;
      const taken = cycles(seed, rate);
      expect(taken).toBeGreaterThan(ideal);
      expect(taken).toBeLessThan(2.5 * ideal);
      expect(cycles(seed, rate)).toBe(taken);
    }
  }
});
