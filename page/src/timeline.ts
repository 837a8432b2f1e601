/** The session as a jsPsych timeline, without the parts that were done in an earlier visit. */

import { initJsPsych } from "jspsych";
import { ScreenPlugin, trialPlugin } from "./plugins";
import { showForm } from "./screens/form";
import { showInstructions } from "./screens/instructions";
import { showJoin } from "./screens/join";
import { showPage, type Page } from "./screens/page";
import { showRating } from "./screens/rating";
import { showSetup } from "./screens/setup";
import type { Outcome, TrialSpec } from "./screens/trial";
import type { Station } from "./station";
import { inARow, trained } from "./training";

/** Number of trials after which a break is offered. */
const BREAK_EVERY = 24;
const PRACTICE = 2;

export async function runSession(station: Station): Promise<void> {
  const session = new Session(station);
  await session.jsPsych.run(session.timeline());
}

type Node = Extract<Parameters<ReturnType<typeof initJsPsych>["run"]>[0], unknown[]>[number];

class Session {
  readonly jsPsych;
  private readonly trial;
  /** Reason why the session ends early; null if it does not. */
  private early: "declined" | "untrained" | null = null;
  /** Practice tasks done, and whether another one follows. */
  private practised = 0;
  private practising = true;
  private note = "";
  private outcome: Outcome = { end: "arrived", cycles: 0 };

  constructor(private readonly station: Station) {
    this.jsPsych = initJsPsych({ display_element: station.frame.stage });
    this.trial = trialPlugin(station);
  }

  timeline(): Node[] {
    const { station } = this;
    return [
      this.screen((e) => showSetup(e, station)),
      this.screen((e) => showJoin(e, station)),
      this.screen(async () => this.joined()),
      this.form("consent", "declined"),
      this.form("demographics"),
      this.instructions(),
      this.practice(),
      this.training(),
      this.trials(),
      this.tlx(),
      this.screen((e) => this.debriefing(e)),
    ];
  }

  // ---- the parts of the session ------------------------------------------------------------------------------------

  private joined(): void {
    const { station } = this;
    station.event("input", station.device?.about() ?? {});
    if (station.progress.over && this.more) this.early = "untrained";
  }

  private form(name: string, onDecline: "declined" | null = null): Node {
    const { station } = this;
    const form = station.experiment.forms.find((f) => f.name === name);
    const show = async (e: HTMLElement): Promise<void> => {
      if (form === undefined) return;
      station.frame.progress(form.title);
      const answers = await showForm(e, station, form);
      if (answers !== null) return station.answer(name, answers);
      this.early = onDecline;
      station.event("declined", { form: name });
    };
    return this.when(
      () => form !== undefined && this.early === null && !station.progress.answered.has(name),
      [this.screen(show)],
    );
  }

  private instructions(): Node {
    const { station } = this;
    return this.when(() => this.untouched, [this.screen((e) => showInstructions(e, station))]);
  }

  /** Practice uses training tasks from the end of the plan, which few subjects reach; it is not recorded. */
  private practice(): Node {
    const { texts } = this.station;
    const choices = [
      { testid: "practice-done", label: texts.get("practice_done") },
      { testid: "practice-more", label: texts.get("practice_more") },
    ];
    const ask = this.screen(async (e) => {
      this.practising = (await this.page(e, "practice", choices)) === "practice-more";
    });
    const task = this.task(
      () => this.practiceTask(),
      () => void (this.practised += 1),
    );
    const loop = {
      timeline: [task, this.when(() => this.practised >= PRACTICE, [ask])],
      loop_function: () => this.practising,
    };
    return this.when(() => this.untouched, [loop]);
  }

  private training(): Node {
    const { station } = this;
    const intro = this.when(
      () => station.progress.training.length === 0,
      [this.screen((e) => this.page(e, "training_intro", [this.choice("training-begin", "go_on")]))],
    );
    const task = this.task(
      () => this.trainingTask(),
      (o) => this.trainingDone(o),
    );
    const loop = { timeline: [task], loop_function: () => !this.isTrained && this.early === null };
    return this.when(() => !this.isTrained && this.early === null, [intro, loop]);
  }

  private trials(): Node {
    const { station } = this;
    const intro = this.when(
      () => station.progress.trials === 0,
      [this.screen((e) => this.page(e, "trials_intro", [this.choice("trials-begin", "go_on")]))],
    );
    const pending = this.when(() => station.progress.unrated, [this.rating()]);
    const task = this.task(
      () => this.trialTask(),
      (o) => this.trialDone(o),
    );
    const rest = this.when(
      () => this.more && station.progress.trials % BREAK_EVERY === 0,
      [this.screen((e) => this.page(e, "break", [this.choice("break-over", "break_over")]))],
    );
    const loop = { timeline: [task, this.rating(), rest], loop_function: () => this.more };
    return this.when(() => this.early === null, [pending, this.when(() => this.more, [intro, loop])]);
  }

  private tlx(): Node {
    return this.when(() => this.station.experiment.tlx && this.early === null, [this.form("tlx")]);
  }

  private async debriefing(element: HTMLElement): Promise<void> {
    const { station } = this;
    station.frame.progress("");
    const stored = station.finish();
    await this.page(element, this.early ?? "debriefing", [this.choice("next-subject", "next_subject")], true);
    await stored;
    location.assign(station.addresses.begin);
  }

  // ---- tasks -------------------------------------------------------------------------------------------------------

  private practiceTask(): TrialSpec {
    const { plan, texts, experiment } = this.station;
    const { q0, target, joint } = plan.training[plan.training.length - 1 - (this.practised % plan.training.length)];
    const law = experiment.training_law;
    return {
      title: texts.get("practice_progress"),
      task: { law, q0, target, joint },
      record: null,
      hints: true,
      note: "",
    };
  }

  private trainingTask(): TrialSpec {
    const { plan, progress, texts, experiment } = this.station;
    const position = progress.training.length;
    const { q0, target, joint } = plan.training[position];
    const title = texts.get("training_progress", {
      number: position + 1,
      in_a_row: inARow(experiment.training, progress.training),
      wanted: experiment.training.in_a_row,
      at_least: experiment.training.at_least,
    });
    const law = experiment.training_law;
    return {
      title,
      task: { law, q0, target, joint },
      record: { kind: "training", position },
      hints: false,
      note: this.note,
    };
  }

  private trainingDone({ end, cycles }: Outcome): void {
    const { progress, experiment, texts } = this.station;
    progress.training.push(end === "arrived" ? cycles : null);
    const seconds = (c: number): string => (c / experiment.rate).toFixed(1);
    const key =
      end !== "arrived" ? "training_missed" : cycles <= experiment.training.limit ? "training_good" : "training_slow";
    this.note = texts.get(key, { seconds: seconds(cycles), limit: seconds(experiment.training.limit) });
    if (!this.isTrained && progress.training.length >= experiment.training.most) this.early = "untrained";
  }

  private trialTask(): TrialSpec {
    const { plan, progress, texts } = this.station;
    const position = progress.trials;
    const { law, q0, target, joint } = plan.trials[position];
    const title = texts.get("trial_progress", { number: position + 1, count: plan.trials.length });
    return {
      title,
      task: { law, q0, target, joint },
      record: { kind: "trial", position },
      hints: false,
      note: "",
    };
  }

  private trialDone(outcome: Outcome): void {
    this.outcome = outcome;
    this.station.progress.trials += 1;
    this.station.progress.unrated = true;
    this.station.frame.occupied = true;
  }

  private rating(): Node {
    const { station } = this;
    return this.screen(async (e) => {
      const rating = await showRating(e, station, this.felt());
      station.progress.unrated = false;
      station.send({ type: "rate", rating, answers: {} });
      station.frame.occupied = false;
    });
  }

  /** Rating of a trial in a dry run; longer trials are rated as more difficult. */
  private felt(): number {
    const steps = this.station.experiment.rating.length;
    if (this.outcome.end !== "arrived") return steps - 1;
    const seconds = this.outcome.cycles / this.station.experiment.rate;
    return Math.min(steps - 1, Math.floor(seconds / 10));
  }

  // ---- helpers ------------------------------------------------------------------------------------------------

  private get isTrained(): boolean {
    const { progress, experiment } = this.station;
    return progress.trials > 0 || trained(experiment.training, progress.training);
  }

  /** True if neither training nor trials have begun. */
  private get untouched(): boolean {
    const { progress } = this.station;
    return this.early === null && progress.trials === 0 && progress.training.length === 0;
  }

  private get more(): boolean {
    return this.early === null && this.station.progress.trials < this.station.plan.trials.length;
  }

  private choice(testid: string, key: string): Page["choices"][number] {
    return { testid, label: this.station.texts.get(key) };
  }

  private page(element: HTMLElement, key: string, choices: Page["choices"], last = false): Promise<string> {
    const { texts, experiment } = this.station;
    const { at_least, in_a_row, limit } = experiment.training;
    const values = {
      at_least,
      in_a_row,
      seconds: (limit / experiment.rate).toFixed(1),
      done: this.station.progress.trials,
      count: this.station.plan.trials.length,
    };
    const [title, text] = [texts.get(`${key}_title`), texts.get(`${key}_text`, values)];
    return showPage(element, this.station, { testid: key.replace("_", "-"), title, text, choices, last });
  }

  private screen(show: (element: HTMLElement) => Promise<unknown>): Node {
    return { type: ScreenPlugin, show };
  }

  private task(spec: () => TrialSpec, done: (outcome: Outcome) => void = () => {}): Node {
    return { type: this.trial, spec, on_finish: (data: Outcome) => done(data) };
  }

  private when(condition: () => boolean, timeline: Node[]): Node {
    return { timeline, conditional_function: condition };
  }
}
