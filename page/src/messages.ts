// Generated from src/holdfast/teleop/serve/messages.py by "python -m tools.typescript_messages"; do not edit.

export const FORMAT = 1;
export const MOST_CYCLES = 256; // in one message

/** First message of a connection: a new session, or one that is resumed. A new session may bring its key, ``fresh``: said again where the answer was lost, it resumes what was begun then. */
export interface Hello {
  type: "hello";
  format: number;
  session: string | null;
  code: string | null;
  kind: "person" | "simulated";
  fresh: string | null;
}

/** Answers of a form. */
export interface AnswersMessage {
  type: "answers";
  seq: number;
  form: string;
  answers: Record<string, string | number | boolean>;
}

/** Beginning of the next trial of the plan. */
export interface Begin {
  type: "begin";
  seq: number;
  kind: "training" | "trial";
  position: number;
}

/** Control cycles of the current trial: time (s since it began), commands, m/cycle, and joints when each cycle began. */
export interface Cycles {
  type: "cycles";
  seq: number;
  first: number;
  time: number[];
  velocity: number[][];
  q: number[][];
}

/** End of the current trial; ``q`` is the final configuration of the arm. */
export interface EndMessage {
  type: "end";
  seq: number;
  end: "arrived" | "aborted" | "time" | "broken-off";
  q: number[];
}

/** Rating of the last trial, a step from 0. */
export interface Rate {
  type: "rate";
  seq: number;
  rating: number;
  answers: Record<string, string | number | boolean>;
}

/** Event in the page: dropped frames, a hidden tab, a lost gamepad. */
export interface EventMessage {
  type: "event";
  seq: number;
  kind: string;
  data: Record<string, string | number | boolean>;
}

/** Task of the training; ``joint`` as in a trial: -1 unless every scenario of the protocol has a failure. */
export interface TrainingTask {
  q0: number[];
  target: number[];
  joint: number;
}

/** Trial of the plan; ``joint`` is the locked joint, from 0, or -1 for none; ``law`` is a code of the arm's, see /arm.js. */
export interface PlannedTrial {
  task: number;
  law: number;
  q0: number[];
  target: number[];
  joint: number;
}

/** Plan of the whole session, so that the page can continue without the network. */
export interface Plan {
  training: TrainingTask[];
  trials: PlannedTrial[];
}

/** Progress on record: cycles of each training task, null where it was not completed, and the number of trials. */
export interface Done {
  training: (number | null)[];
  trials: number;
}

/** Answer to hello; ``seq`` is the last message on record, ``unrated`` is true if the last trial has no rating yet. */
export interface Welcome {
  type: "welcome";
  session: string;
  subject: string;
  seq: number;
  plan: Plan;
  done: Done;
  unrated: boolean;
  answered: string[];
  paused: boolean;
  over: boolean;
}

/** Acknowledgement that all messages up to ``seq`` are on the disk. */
export interface Ack {
  type: "ack";
  seq: number;
}

/** Refusal of a message that changed nothing, with the reason; ``last`` is the last on record. A ``seq`` up to ``last`` is on record already. */
export interface Refused {
  type: "refused";
  seq: number | null;
  reason: string;
  last: number;
}

/** Message that the experimenter pauses the session after the current trial, or resumes it. */
export interface Pause {
  type: "pause";
  paused: boolean;
}

/** Message that the records cannot be written: the disk is full, or the folder was deleted. Acknowledgements resume after welcome. */
export interface Unstored {
  type: "unstored";
}

/** Last message before the server closes the connection for good, with the reason; the page does not reconnect by itself. */
export interface Bye {
  type: "bye";
  reason: string;
}

export type FromPage = Hello | AnswersMessage | Begin | Cycles | EndMessage | Rate | EventMessage;

export type FromServer = Welcome | Ack | Refused | Pause | Unstored | Bye;
