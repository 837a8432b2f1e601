import { describe, expect, it } from "vitest";
import { between, frames } from "../src/viewer/algebra";
import { Camera, project } from "../src/viewer/camera";
import { corners, hull } from "../src/viewer/hulls";
import type { Scene, Vector } from "../src/viewer/scene";
import { mesh, tube, type Triangles } from "../src/viewer/shapes";
import { cell, edges } from "../src/viewer/things";

const still = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
const scene = {
  up: [0, 0, 1],
  size: 1,
  camera: { azimuth: 0.7, elevation: 0.4, center: [1, 2, 3], radius: 0.5 },
} as unknown as Scene;

/** Six times the volume of a closed body, above 0 if its corners run round as seen from outside (Gauss). */
function volume(shape: Triangles): number {
  let out = 0;
  for (let k = 0; k < shape.length; k += 18) {
    const [a, b, c] = [0, 6, 12].map((j) => shape.subarray(k + j, k + j + 3));
    out += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return out / 6;
}

const encoded = (numbers: number[]): string => btoa(String.fromCharCode(...new Uint8Array(new Uint16Array(numbers).buffer)));

describe("the view", () => {
  it("turns and slides joints in their order", () => {
    const joint = { name: "", origin: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 2], axis: [0, 0, 1] as Vector, low: null, high: null };
    const chain = { base: still, joints: [{ ...joint, slides: false }, { ...joint, slides: true }], tool: [...still.slice(0, 3), 5, ...still.slice(4)] };
    const poses = frames(chain, [Math.PI / 2, 0.5]);
    expect(poses.length).toBe(4);
    [0, 5, 4.5].forEach((x, k) => expect(poses[3][4 * k + 3]).toBeCloseTo(x, 12));
    expect(between([[0, 1], [2, 3]], 0.5)).toEqual([1, 2]);
    expect(between([[0, 1]], 0)).toEqual([0, 1]);
  });

  it("puts what is in the middle into the middle, and everything onto the picture whatever its shape", () => {
    const camera = new Camera(scene);
    for (const [width, height] of [[800, 500], [300, 600]]) {
      const matrix = camera.matrix(width / height);
      const [x, y] = project(matrix, [1, 2, 3], width, height);
      expect([x, y].map(Math.round)).toEqual([width / 2, height / 2]);
      for (let k = 0; k < 200; k++) {
        const [a, b] = [k * 2.4, Math.acos(1 - (2 * k + 1) / 200)];
        const p: Vector = [1 + 0.5 * Math.sin(b) * Math.cos(a), 2 + 0.5 * Math.sin(b) * Math.sin(a), 3 + 0.5 * Math.cos(b)];
        const [u, v] = project(matrix, p, width, height);
        expect(u > 0 && u < width && v > 0 && v < height).toBe(true);
      }
    }
    const above = project(camera.matrix(1), [1, 2, 3.2], 100, 100);
    expect(above[1]).toBeLessThan(50);
  });

  it("makes closed bodies that look outwards", () => {
    const ring = (28 * Math.sin((2 * Math.PI) / 28)) / 2;
    expect(volume(tube([0, 0, 1], [1, 2, 3], 0.1, false))).toBeCloseTo(ring * 0.01 * 3, 6);
    const [round, whole] = [volume(tube([0, 0, 1], [1, 2, 3], 0.1, true)), Math.PI * (0.03 + (4 / 3) * 0.001)];
    expect(Math.abs(round - whole)).toBeLessThan(0.03 * whole);
  });

  it("reads meshes, and keeps their edges", () => {
    const points = encoded([0, 0, 0, 65535, 0, 0, 0, 65535, 0, 0, 0, 65535]);
    const shape = mesh({ low: [1, 1, 1], side: 2, points, faces: encoded([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]) });
    expect(volume(shape)).toBeCloseTo(8 / 6, 5);
    expect([...shape.subarray(3, 6)]).toEqual([0, 0, -1]);
  });

  it("has hulls that hold every point, and no corner that another would replace", () => {
    const points = Array.from({ length: 300 }, (_, k) => [Math.sin(k * k), Math.cos(7 * k) + Math.sin(k * k) / 3]);
    const outline = hull([...points, ...points]);
    const turn = (a: number[], b: number[], c: number[]): number => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    outline.forEach((corner, k) => {
      const next = outline[(k + 1) % outline.length];
      expect(points).toContainEqual(corner);
      expect(turn(corner, next, outline[(k + 2) % outline.length])).toBeGreaterThan(0);
      for (const point of points) expect(turn(corner, next, point)).toBeGreaterThanOrEqual(-1e-12);
    });
  });

  it("finds the corners of tubes and meshes", () => {
    const ends = corners({ frame: 0, color: [0, 0, 0], tube: [0, 0, 1, 0, 3, 1, 0.2] });
    expect(ends.length).toBe(40);
    ends.forEach(([x, y, z], k) => {
      expect(Math.hypot(x, z - 1)).toBeCloseTo(0.2, 12);
      expect(y).toBeCloseTo(k < 20 ? 0 : 3, 12);
    });
    const numbers = [0, 9e3, 65535].flatMap((x) => [0, 8e3, 65535].flatMap((y) => [0, 7e3, 65535].flatMap((z) => [x, y, z])));
    const cube = corners({ frame: 0, color: [0, 0, 0], mesh: { low: [1, 1, 1], side: 2, points: encoded(numbers), faces: "" } });
    const [low, high] = [[1, 1, 1], [3, 3, 3]] as [Vector, Vector];
    expect(new Set(cube.map(String))).toEqual(new Set(edges({ low, high }).map(String)));
  });

  it("has a floor of round numbers", () => {
    expect([0.9, 1.7, 3, 8].map(cell)).toEqual([0.1, 0.2, 0.2, 1]);
    expect(edges({ low: [0, 0, 0], high: [1, 1, 1] }).length).toBe(24);
  });
});
