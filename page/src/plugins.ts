/** Our jsPsych plugins: a trial, and any other screen. */

import { ParameterType, type JsPsych, type JsPsychPlugin, type TrialType } from "jspsych";
import { performTrial, type TrialSpec } from "./screens/trial";
import type { Station } from "./station";

const trialInfo = {
  name: "holdfast-trial",
  version: "1.0.0",
  parameters: {
    /** A {@link TrialSpec}. */
    spec: { type: ParameterType.OBJECT, default: undefined },
  },
  data: {
    /** Ending of the trial. */
    end: { type: ParameterType.STRING },
    /** Control cycles. */
    cycles: { type: ParameterType.INT },
  },
} as const;

/** The plugin for a trial with the arm. */
export function trialPlugin(station: Station) {
  return class implements JsPsychPlugin<typeof trialInfo> {
    static readonly info = trialInfo;

    constructor(readonly jsPsych: JsPsych) {}

    async trial(element: HTMLElement, trial: TrialType<typeof trialInfo>): Promise<{ end: string; cycles: number }> {
      return performTrial(element, station, trial.spec as TrialSpec);
    }
  };
}

const screenInfo = {
  name: "holdfast-screen",
  version: "1.0.0",
  parameters: {
    /** Shows the screen in an element and resolves to the data of the trial. */
    show: { type: ParameterType.FUNCTION, default: undefined },
  },
  data: {
    result: { type: ParameterType.OBJECT },
  },
} as const;

/** The plugin for all other screens: a function that shows a screen until the person has finished with it. */
export class ScreenPlugin implements JsPsychPlugin<typeof screenInfo> {
  static readonly info = screenInfo;

  constructor(readonly jsPsych: JsPsych) {}

  async trial(element: HTMLElement, trial: TrialType<typeof screenInfo>): Promise<{ result: unknown }> {
    const show = trial.show as unknown as (element: HTMLElement) => Promise<unknown>;
    return { result: (await show(element)) ?? null };
  }
}
