/** State of the page in the fragment of its address, so that a state can be shared and opened again. */

import type { ArmPageData } from "./data";

export type Condition = "healthy" | "locked" | "free";

export interface PageState {
  arm: string;
  /** Name of the step, a key of `STEP_CLASSES` or of the steps of the studio. */
  step: string;
  /** Joint values, rad or m. */
  q: ArrayLike<number>;
  conditions: Condition[];
  /** Time from the power cut until the brakes close, ms. */
  brakeDelay: number;
}

/** Joints, from 0, with one of the conditions. */
export const listJoints = (conditions: Condition[], ...chosen: Condition[]): number[] =>
  conditions.flatMap((condition, joint) => (chosen.includes(condition) ? [joint] : []));

export function writeAddress(state: PageState): string {
  const joints = (condition: Condition): string =>
    listJoints(state.conditions, condition).map((joint) => joint + 1).join(",");
  const fields: Record<string, string> = {
    arm: state.arm,
    step: state.step,
    q: Array.from(state.q, (value) => String(Number(value.toFixed(6)))).join(","),
    locked: joints("locked"),
    free: joints("free"),
    brake: state.step === "power" ? String(state.brakeDelay) : "",
  };
  const filled = Object.entries(fields).filter(([, text]) => text);
  return `#${filled.map(([key, text]) => `${key}=${encodeURIComponent(text)}`).join("&")}`;
}

/** Read a state; fields that are missing or do not fit the arm keep their defaults. */
export function readAddress(fragment: string, data: ArmPageData, defaults: PageState, steps: string[]): PageState {
  const fields = new URLSearchParams(fragment.replace(/^#/, ""));
  const state = { ...defaults, conditions: [...defaults.conditions] };
  if (fields.get("arm") !== null && fields.get("arm") !== data.name) return state;
  state.step = steps.find((name) => name === fields.get("step")) ?? state.step;
  const q = (fields.get("q") ?? "").split(",").map(Number);
  if (fields.get("q") && q.length === state.q.length && q.every(Number.isFinite)) state.q = q;
  for (const condition of ["locked", "free"] as const) {
    for (const text of (fields.get(condition) ?? "").split(",")) {
      if (Number(text) >= 1 && Number(text) <= state.q.length) state.conditions[Number(text) - 1] = condition;
    }
  }
  const delay = Number(fields.get("brake") ?? "");
  if (fields.get("brake") && delay >= 0 && delay <= 1000) state.brakeDelay = delay;
  return state;
}
