/** Questions of the studio, which a local Python server answers; holdfast/interface/studio/answers.py gives the answers. */

import type { Condition } from "./address";
import type { Vector } from "../viewer/scene";
import type { PlayedMotion } from "./playback";

/** A view of the studio: those fields of the Python class `State` that the page reads or changes. */
export interface StudioState {
  names: string[];
  q: number[];
  conditions: Condition[];
  index: string;
  susceptibility: string;
  objective: string;
  laws: [string, string];
  /** Position, m, and quaternion x, y, z, w of the target. */
  target: number[] | null;
  show: string;
  file: string | null;
  region: string | null;
  time: number;
  moved: [string, number[]][];
  /** Kind of the fault, joint, and its time, s. */
  fault: [string, string, number];
  friction: number | null;
}

/** What the page of the studio has in addition to `ArmPageData`. */
export interface StudioData {
  token: string;
  state: StudioState;
  indices: string[];
  susceptibilities: string[];
  laws: string[];
  faults: string[];
  objects: { name: string; pose: number[] }[];
}

export interface JointBars {
  title: string;
  better: "larger" | "smaller";
  unit: string[];
  /** Null where the value is infinite, or where there is none. */
  values: (number | null)[];
  worst: number;
  status: string;
}

export interface Cloud {
  label: string;
  points: Vector[];
  /** Colours of the points, 0 to 255. */
  colors: Vector[];
  /** Configuration of each point; null where none was found. */
  q: (number[] | null)[];
  values: (number | null)[];
}

export interface Watch {
  motion: PlayedMotion;
  /** Times of the residuals, s. */
  time: number[];
  /** Residual of each joint (T x n), or of the tool (T x 1), divided by its threshold. */
  signals: { label: string; values: (number | null)[][] }[];
  /** Times of the fault and of the alarm, s, and the joint, from 0, that the monitor has isolated from a time on, s. */
  onset: number | null;
  alarm: number | null;
  isolated: { joint: number; from: number } | null;
  /** Sentences of the monitor, each from a time on, s. */
  sentences: { from: number; text: string }[];
}

/** Answer to each question. */
export interface Answers {
  reading: {
    index: JointBars | string;
    susceptibility: JointBars | string;
    powerLoss: string;
    clearance: string;
    /** Shortest distance between the arm and an object; null without a cell. */
    nearest: { arm: Vector; object: Vector; name: string; blocked: boolean } | null;
    /** A target that the arm reaches: position, m, and quaternion x, y, z, w. */
    target: number[];
    command: string;
  };
  /** Values of the best, the worst, and the present configuration; null where one is infinite. */
  "best-worst": { q: [number[], number[]]; values: (number | null)[] };
  laws: PlayedMotion[];
  fall: PlayedMotion[];
  stow: PlayedMotion[];
  region: Cloud;
  watch: Watch;
  /** A file that the visitor opens: a motion to play, or the address of the page of another arm. */
  open: { motion: PlayedMotion } | { address: string };
  drawing: { svg: string };
  "cell-file": { name: string; text: string; command: string };
}

export type Question = keyof Answers;

export interface AskOptions {
  signal?: AbortSignal;
  /** Called with the number of steps that are done, and of all. */
  progress?: (done: number, total: number) => void;
  /** A file that the visitor opens, with its content in base64. */
  file?: { name: string; content: string };
  /** Further configurations of a drawing. */
  ghosts?: number[][];
}

/** Ask the server; an abort of `signal` stops the computation. */
export async function ask<Q extends Question>(
  question: Q,
  token: string,
  state: StudioState,
  options: AskOptions = {},
): Promise<Answers[Q]> {
  const reply = await fetch(`answer/${question}`, {
    method: "POST",
    headers: { "Content-Type": "application/json", "X-Token": token },
    body: JSON.stringify({ state, file: options.file ?? null, ghosts: options.ghosts ?? [] }),
    signal: options.signal ?? null,
  });
  if (!reply.body) throw new Error("The server has stopped.");
  const reader = reply.body.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (;;) {
    const { value, done } = await reader.read();
    text += value ?? "";
    const lines = text.split("\n");
    text = lines.pop() ?? "";
    for (const line of lines) {
      const message = JSON.parse(line) as { progress?: [number, number]; error?: string; answer?: Answers[Q] };
      if (message.error !== undefined) throw new Error(message.error);
      if (message.progress) options.progress?.(...message.progress);
      if (message.answer !== undefined) return message.answer;
    }
    if (done) throw new Error("The server has stopped.");
  }
}
