import { expect, test } from "vitest";
import type { Experiment } from "../src/experiment";
import { Random } from "../src/random";
import { enclosePoses, type Drawn } from "../src/screens/windows";
import { Texts } from "../src/texts";
import { slides } from "./toy";

test("without a workspace boundary, the windows show all arms and targets with a margin of a tenth", () => {
  const random = new Random(4);
  const place = (): number[] => [3 * random.uniform() - 1, 3 * random.uniform() - 1];
  const pose = (): { q0: number[]; target: number[] } => ({ q0: place(), target: place() });
  const views = [{ label: "", rows: [[1, 0, 0], [0, 1, 0]] }];
  const plan = { training: [pose(), pose()], trials: [pose()] };
  const experiment = { reach: null, views } as Partial<Experiment> as Experiment;
  const drawn: Drawn = { experiment, texts: new Texts({}), arm: slides, plan };
  const { middles: [middle], extent } = enclosePoses(drawn);
  const places = [[0, 0], ...[...plan.training, ...plan.trials].flatMap(({ q0, target }) => [q0, target])];
  const distances = [0, 1].map((axis) => {
    const offsets = places.map((p) => p[axis] - middle[axis]);
    expect(Math.max(...offsets)).toBeCloseTo(-Math.min(...offsets), 12);
    return Math.max(...offsets);
  });
  expect(extent).toBeCloseTo(1.1 * Math.max(...distances), 12);
});
