/** Triangles with normals. */

import { cross, dot, sum, unit } from "./algebra";
import type { Part, Vector } from "./scene";
import { circle } from "./things";

/** Three vertices a triangle, six numbers a vertex: place and normal. */
export type Triangles = Float32Array;

const SIDES = 28;
const RINGS = 7; // of a round end
const CREASE = Math.cos((40 * Math.PI) / 180); // edges sharper than this are seen as edges

/** A cylinder between two points, its ends flat or half balls. */
export function tube(start: Vector, end: Vector, radius: number, round: boolean): Triangles {
  const axis = unit(sum(end, start, -1));
  const rings = round ? RINGS : 1;
  const rims = [-1, 1].flatMap((sign) =>
    Array.from({ length: rings + 1 }, (_, k) => {
      const t = (Math.PI / 2) * (sign < 0 ? 1 - k / rings : k / rings);
      const center = sum(sign < 0 ? start : end, axis, round ? sign * radius * Math.sin(t) : 0);
      return circle(center, axis, radius * Math.cos(t), SIDES);
    }),
  );
  const faces: number[] = [];
  for (let k = 0; k < (rims.length - 1) * SIDES; k++) {
    const next = k % SIDES < SIDES - 1 ? k + 1 : k + 1 - SIDES; // round the ring
    faces.push(k, next, next + SIDES, k, next + SIDES, k + SIDES);
  }
  return smooth(rims.flat(), faces);
}

function bytes(text: string): ArrayBuffer {
  const letters = atob(text);
  const out = new Uint8Array(letters.length);
  for (let k = 0; k < letters.length; k++) out[k] = letters.charCodeAt(k);
  return out.buffer;
}

/** Coordinates x, y, z of the vertices of a mesh, m. */
export function vertices({ low, side, points }: NonNullable<Part["mesh"]>): Float64Array {
  return Float64Array.from(new Uint16Array(bytes(points)), (number, k) => low[k % 3] + (side * number) / 65535);
}

/** A mesh as its file has it. */
export function mesh(part: NonNullable<Part["mesh"]>): Triangles {
  const numbers = vertices(part);
  const points = Array.from({ length: numbers.length / 3 }, (_, k) => [...numbers.subarray(3 * k, 3 * k + 3)] as Vector);
  return smooth(points, [...new Uint16Array(bytes(part.faces))]);
}

/** Triangles between points, smooth except at sharp edges. */
function smooth(points: Vector[], corners: number[]): Triangles {
  const normals: Vector[] = []; // as long as twice the areas
  const around: number[][] = [];
  for (let f = 0; f < corners.length; f += 3) {
    const [a, b, c] = [0, 1, 2].map((j) => points[corners[f + j]]);
    normals.push(cross(sum(b, a, -1), sum(c, a, -1)));
    for (let j = 0; j < 3; j++) (around[corners[f + j]] ??= []).push(f / 3);
  }
  const units = normals.map(unit);
  return new Float32Array(
    corners.flatMap((corner, k) => {
      const own = units[Math.floor(k / 3)];
      const near = around[corner].filter((f) => dot(own, units[f]) > CREASE);
      return [...points[corner], ...unit(near.reduce((normal, f) => sum(normal, normals[f]), [0, 0, 0] as Vector))];
    }),
  );
}

export function triangles(part: Part): Triangles {
  if (part.mesh) return mesh(part.mesh);
  const [a, b, c, d, e, f, radius] = part.tube as number[];
  return tube([a, b, c], [d, e, f], radius, part.round === true);
}
