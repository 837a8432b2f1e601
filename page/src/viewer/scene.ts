/** Input of a view: the JSON that holdfast/interface/report/viewer.py writes next to its canvas. */

export type Vector = [number, number, number];
/** A pose: the upper three rows, row by row. */
export type Pose = number[];

export interface Joint {
  name: string;
  origin: Pose;
  axis: Vector;
  slides: boolean;
  low: number | null;
  high: number | null;
}

export interface Chain {
  base: Pose;
  joints: Joint[];
  tool: Pose;
}

export interface Part {
  /** 0 for the base, k + 1 for what moves with joint k. */
  frame: number;
  /** The joint that it shows, from 0; none for a link. */
  joint?: number;
  color: Vector;
  /** From x, y, z to x, y, z, and a radius; with round ends or flat ones. */
  tube?: number[];
  round?: boolean;
  /** Triangles: numbers of 16 bits in a cube of a side, and the corners of each triangle. */
  mesh?: { low: Vector; side: number; points: string; faces: string };
  /** Drawn over everything else, and only while its joint is locked. */
  mark?: boolean;
  /** An object around the arm. */
  object?: boolean;
}

export interface Arm {
  label: string;
  /** One configuration for each frame of the motion; one alone where nothing moves. */
  q: number[][];
}

export interface Lost {
  /** Linear, then angular, world frame, of norm 1. */
  twist: number[];
  words: string;
}

export interface Scene extends Chain {
  up: Vector;
  /** Length of the stretched arm, m. */
  size: number;
  parts: Part[];
  arms: Arm[];
  /** For each joint the time from which it is locked; none if it is healthy. */
  locked: (number | null)[];
  /** Joints, from 0, that swing freely. */
  free: number[];
  time: number[];
  seconds: number;
  readings: string[];
  path: Vector[];
  targets: Pose[];
  /** Where a target has no orientation, its pose is that of the world. */
  boxes: { low: Vector; high: Vector }[];
  points: Vector[];
  colors: Vector[];
  /** Names and positions of the objects around the arm. */
  objects: { name: string; at: Vector }[];
  lost: Lost[];
  sliders: boolean;
  camera: { azimuth: number; elevation: number; center: Vector; radius: number };
}
