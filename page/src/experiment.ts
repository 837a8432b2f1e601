/** Description of the experiment from the server. */

import type { Criterion } from "./training";

/** A projection of points of the base frame on two axes of the screen: to the right, and up. */
export interface View {
  label: string;
  rows: [number[], number[]];
}

export interface Question {
  name: string;
  /** One of the options; a box that must be ticked; a step of a scale; a number; a line of text. */
  kind: "choice" | "check" | "scale" | "number" | "text";
  label: string;
  help?: string;
  optional?: boolean;
  options?: { value: string; label: string }[];
  /** Of a scale or number. */
  from?: number;
  to?: number;
  step?: number;
  low?: string;
  high?: string;
}

export interface Form {
  name: string;
  title: string;
  text: string;
  questions: Question[];
  submit: string;
  /** Label of a button that ends the session; none if not given. */
  decline?: string;
}

export interface Experiment {
  format: 1;
  joints: number;
  axes: number;
  /** Control cycles per second. */
  rate: number;
  /** m/cycle. */
  stick: { limit: number; dead_zone: number };
  /** Radius of the target circle, m. */
  radius: number;
  /** Cycles allowed; null for no limit. */
  cycle_limit: number | null;
  rating: string[];
  training: Criterion;
  /** Code of the law of the training. */
  training_law: number;
  /** Radius of the workspace's boundary, m; null where none is drawn. */
  reach: number | null;
  centre: number[];
  views: View[];
  texts: Record<string, string>;
  forms: Form[];
  tlx: boolean;
}

export async function loadExperiment(address: string): Promise<Experiment> {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${address}: ${answer.status} ${answer.statusText}`);
  return (await answer.json()) as Experiment;
}
