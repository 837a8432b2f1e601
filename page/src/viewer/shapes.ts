/** Triangles with normals. */

import { across, cross, sum, unit } from "./algebra";
import type { Part, Vector } from "./scene";

/** Three vertices a triangle, six numbers a vertex: place and normal. */
export type Triangles = Float32Array;

const SIDES = 28;
const RINGS = 7; // of a round end
const CREASE = Math.cos((40 * Math.PI) / 180); // edges sharper than this are seen as edges

/** A cylinder between two points, its ends flat or half balls. */
export function tube(start: Vector, end: Vector, radius: number, round: boolean): Triangles {
  const axis = unit(sum(end, start, -1));
  const first = across(axis);
  const second = cross(axis, first);
  // Profile along the axis: place on the axis, share of the radius, and the normal's share along the axis.
  const profile: { at: Vector; out: number; along: number }[] = [];
  if (round) {
    for (const [middle, sign] of [[start, -1] as const, [end, 1] as const]) {
      for (let k = 0; k <= RINGS; k++) {
        const t = (Math.PI / 2) * (sign < 0 ? 1 - k / RINGS : k / RINGS);
        profile.push({ at: sum(middle, axis, sign * radius * Math.sin(t)), out: Math.cos(t), along: sign * Math.sin(t) });
      }
    }
  } else {
    for (const [at, out, along] of [
      [start, 0, -1],
      [start, 1, -1],
      [start, 1, 0],
      [end, 1, 0],
      [end, 1, 1],
      [end, 0, 1],
    ] as const) {
      profile.push({ at, out, along });
    }
  }
  const vertices: number[] = [];
  const put = (k: number, i: number): void => {
    const { at, out, along } = profile[k];
    const t = (2 * Math.PI * i) / SIDES;
    const way = sum(sum([0, 0, 0], first, Math.cos(t)), second, Math.sin(t));
    const level = Math.abs(along) === 1 ? 0 : Math.sqrt(1 - along * along);
    vertices.push(...sum(at, way, radius * out), ...sum(sum([0, 0, 0], way, level), axis, along));
  };
  for (let k = 0; k + 1 < profile.length; k++) {
    if (profile[k].along !== profile[k + 1].along || profile[k].out !== profile[k + 1].out || profile[k].along === 0) {
      for (let i = 0; i < SIDES; i++) {
        for (const [a, b] of [[0, 0], [0, 1], [1, 1], [0, 0], [1, 1], [1, 0]]) put(k + a, i + b);
      }
    }
  }
  return new Float32Array(vertices);
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

/** A mesh as its file has it, smooth but for its edges. */
export function mesh(part: NonNullable<Part["mesh"]>): Triangles {
  const numbers = vertices(part);
  const corners = new Uint16Array(bytes(part.faces));
  const at = (k: number): Vector => [...numbers.subarray(3 * corners[k], 3 * corners[k] + 3)] as Vector;
  const count = corners.length / 3;
  const large: Vector[] = []; // normals as long as twice the areas
  const small: Vector[] = [];
  const around: number[][] = [];
  for (let f = 0; f < count; f++) {
    const [a, b, c] = [at(3 * f), at(3 * f + 1), at(3 * f + 2)];
    large.push(cross(sum(b, a, -1), sum(c, a, -1)));
    small.push(unit(large[f]));
    for (let j = 0; j < 3; j++) (around[corners[3 * f + j]] ??= []).push(f);
  }
  const out = new Float32Array(18 * count);
  for (let k = 0; k < corners.length; k++) {
    const own = small[Math.floor(k / 3)];
    let normal: Vector = [0, 0, 0];
    for (const f of around[corners[k]]) {
      if (own[0] * small[f][0] + own[1] * small[f][1] + own[2] * small[f][2] > CREASE) normal = sum(normal, large[f]);
    }
    out.set(at(k), 6 * k);
    out.set(unit(normal), 6 * k + 3);
  }
  return out;
}

export function triangles(part: Part): Triangles {
  if (part.mesh) return mesh(part.mesh);
  const [a, b, c, d, e, f, radius] = part.tube as number[];
  return tube([a, b, c], [d, e, f], radius, part.round === true);
}
