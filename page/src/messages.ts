// Generated from src/holdfast/teleop/serve/messages.py by "python -m holdfast.teleop.serve.typescript_messages"; do not edit.

export const FORMAT = 1;
export const MOST_CYCLES = 256; // in one message
export const MOST_BYTES = 131072; // of one message

/** The first message of a connection: a new session, or one that is resumed. A new session may bring its key, ``fresh``: said again where the answer was lost, it resumes what was begun then. */
export interface Hello {
  type: "hello";
  format: number;
  session: string | null;
  code: string | null;
  kind: "person" | "simulated";
  fresh: string | null;
}

/** A form was filled in. */
export interface AnswersMessage {
  type: "answers";
  seq: number;
  form: string;
  answers: Record<string, string | number | boolean>;
}

/** A trial begins: the next of the plan. */
export interface Begin {
  type: "begin";
  seq: number;
  kind: "training" | "trial";
  position: number;
}

/** Control cycles of the trial under way: when (s since it began), commands, m/cycle, and joints when each began. */
export interface Cycles {
  type: "cycles";
  seq: number;
  first: number;
  time: number[];
  velocity: number[][];
  q: number[][];
}

/** The trial under way is over; ``q`` is where the arm is. */
export interface EndMessage {
  type: "end";
  seq: number;
  end: "arrived" | "aborted" | "time" | "broken-off";
  q: number[];
}

/** The rating of the last trial, a step from 0. */
export interface Rate {
  type: "rate";
  seq: number;
  rating: number;
  answers: Record<string, string | number | boolean>;
}

/** Something happened in the page: dropped frames, a hidden tab, a lost pad. */
export interface EventMessage {
  type: "event";
  seq: number;
  kind: string;
  data: Record<string, string | number | boolean>;
}

/** A task of the training; ``joint`` as in a trial: -1 unless every scenario of the protocol has a failure. */
export interface TrainingTask {
  q0: number[];
  target: number[];
  joint: number;
}

/** A trial; ``joint`` is the one that is locked in it, from 0, -1 for none; ``law`` is a code of the arm's, see /arm.js. */
export interface PlannedTrial {
  task: number;
  law: number;
  q0: number[];
  target: number[];
  joint: number;
}

/** The whole session, so that the page can continue without the network. */
export interface Plan {
  training: TrainingTask[];
  trials: PlannedTrial[];
}

/** What is on record: cycles of each training task, null where it was not completed, and how many trials. */
export interface Done {
  training: (number | null)[];
  trials: number;
}

/** The answer to hello; ``seq`` is the last message on record, ``unrated`` says that the last trial has no rating yet. */
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

/** All messages up to ``seq`` are on the disk. */
export interface Ack {
  type: "ack";
  seq: number;
}

/** A message changed nothing, and why; ``last`` is the last on record. A ``seq`` up to ``last`` is on record already. */
export interface Refused {
  type: "refused";
  seq: number | null;
  reason: string;
  last: number;
}

/** The experimenter stops the session after the trial under way, or resumes it. */
export interface Pause {
  type: "pause";
  paused: boolean;
}

/** The records cannot be written: the disk is full, or the folder was deleted. Nothing more is acknowledged till welcome. */
export interface Unstored {
  type: "unstored";
}

/** The server closes the connection for good, and why; the page does not come back by itself. */
export interface Bye {
  type: "bye";
  reason: string;
}

export type FromPage = Hello | AnswersMessage | Begin | Cycles | EndMessage | Rate | EventMessage;

export type FromServer = Welcome | Ack | Refused | Pause | Unstored | Bye;
