/** The jsPsych plugin for every screen, trials included. */

import { ParameterType, type JsPsych, type JsPsychPlugin, type TrialType } from "jspsych";

/** Shows a screen in an element until the person has finished with it. */
export type Show = (element: HTMLElement) => Promise<void>;

const info = {
  name: "holdfast-screen",
  version: "1.0.0",
  parameters: { show: { type: ParameterType.FUNCTION, default: undefined } },
  data: {},
} as const;

export class ScreenPlugin implements JsPsychPlugin<typeof info> {
  static readonly info = info;

  constructor(readonly jsPsych: JsPsych) {}

  async trial(element: HTMLElement, trial: TrialType<typeof info>): Promise<Record<string, never>> {
    await (trial.show as unknown as Show)(element);
    return {};
  }
}
