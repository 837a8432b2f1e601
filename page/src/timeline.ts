/** The session as a jsPsych timeline, without the parts that were done in an earlier visit. */

import { initJsPsych } from "jspsych";
import { ScreenPlugin, type Show } from "./plugins";
import { showForm } from "./screens/form";
import { showInstructions } from "./screens/instructions";
import { showJoin } from "./screens/join";
import { showPage, type Choice } from "./screens/page";
import { showRating } from "./screens/rating";
import { showSetup } from "./screens/setup";
import { performTrial, type Outcome, type TrialSpec } from "./screens/trial";
import type { Station } from "./station";
import { inARow, trained } from "./training";

/** Number of trials after which a break is offered. */
const BREAK_EVERY = 24;
const PRACTICE = 2;

export async function runSession(station: Station): Promise<void> {
  await initJsPsych({ display_element: station.frame.stage }).run(new Session(station).timeline());
}

type Node = Extract<Parameters<ReturnType<typeof initJsPsych>["run"]>[0], unknown[]>[number];

class Session {
  /** Reason why the session ends early; null if it does not. */
  private early: "declined" | "untrained" | null = null;
  /** Practice tasks done, and whether another one follows. */
  private practised = 0;
  private practising = true;
  private note = "";
  private outcome: Outcome = { end: "arrived", cycles: 0 };

  constructor(private readonly station: Station) {}

  timeline(): Node[] {
    const { station } = this;
    return [
      this.screen((e) => showSetup(e, station)),
      this.screen((e) => showJoin(e, station)),
      this.screen(async () => this.joined()),
      this.form("consent", "declined"),
      this.form("demographics"),
      this.when(() => this.untouched, [this.screen((e) => showInstructions(e, station))]),
      this.practice(),
      this.training(),
      this.trials(),
      this.when(() => station.experiment.tlx && this.early === null, [this.form("tlx")]),
      this.screen((e) => this.debriefing(e)),
    ];
  }

  // ---- the parts of the session ------------------------------------------------------------------------------------

  private joined(): void {
    const { station } = this;
    if (station.device) station.event("input", { device: station.device.kind, ...station.device.about?.() });
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
    const asked = (): boolean => form !== undefined && this.early === null && !station.progress.answered.has(name);
    return this.when(asked, [this.screen(show)]);
  }

  /** Practice uses training tasks from the end of the plan, which few subjects reach; it is not recorded. */
  private practice(): Node {
    const { texts } = this.station;
    const choices = ["done", "more"].map((name) => ({ testid: `practice-${name}`, label: texts.get(`practice_${name}`) }));
    const ask = this.screen(async (e) => {
      this.practising = (await this.page(e, "practice", choices)) === "practice-more";
    });
    const task = this.task(() => this.practiceTask(), () => this.practised++);
    const loop = { timeline: [task, this.when(() => this.practised >= PRACTICE, [ask])], loop_function: () => this.practising };
    return this.when(() => this.untouched, [loop]);
  }

  private training(): Node {
    const { station } = this;
    const notice = this.notice("training_intro", "training-begin", "go_on");
    const intro = this.when(() => station.progress.training.length === 0, [notice]);
    const task = this.task(() => this.trainingTask(), (outcome) => this.trainingDone(outcome));
    const wanted = (): boolean => !this.isTrained && this.early === null;
    return this.when(wanted, [intro, { timeline: [task], loop_function: wanted }]);
  }

  private trials(): Node {
    const { station } = this;
    const intro = this.when(() => station.progress.trials === 0, [this.notice("trials_intro", "trials-begin", "go_on")]);
    const pending = this.when(() => station.progress.unrated, [this.rating()]);
    const task = this.task(() => this.trialTask(), (outcome) => this.trialDone(outcome));
    const due = (): boolean => this.more && station.progress.trials % BREAK_EVERY === 0;
    const rest = this.when(due, [this.notice("break", "break-over", "break_over")]);
    const loop = { timeline: [task, this.rating(), rest], loop_function: () => this.more };
    return this.when(() => this.early === null, [pending, this.when(() => this.more, [intro, loop])]);
  }

  private async debriefing(element: HTMLElement): Promise<void> {
    const { station } = this;
    station.frame.progress("");
    const stored = station.finish();
    const choices = [{ testid: "next-subject", label: station.texts.get("next_subject") }];
    await this.page(element, this.early ?? "debriefing", choices, true);
    await stored;
    location.assign(station.addresses.begin);
  }

  // ---- tasks -------------------------------------------------------------------------------------------------------

  private practiceTask(): TrialSpec {
    const { plan, texts, experiment } = this.station;
    const task = plan.training[plan.training.length - 1 - (this.practised % plan.training.length)];
    return { title: texts.get("practice_progress"), task: { ...task, law: experiment.training_law }, record: null, note: "" };
  }

  private trainingTask(): TrialSpec {
    const { plan, progress, texts, experiment } = this.station;
    const position = progress.training.length;
    const title = texts.get("training_progress", {
      number: position + 1,
      in_a_row: inARow(experiment.training, progress.training),
      wanted: experiment.training.in_a_row,
      at_least: experiment.training.at_least,
    });
    const task = { ...plan.training[position], law: experiment.training_law };
    return { title, task, record: { kind: "training", position }, note: this.note };
  }

  private trainingDone({ end, cycles }: Outcome): void {
    const { progress, experiment, texts } = this.station;
    const { limit, most } = experiment.training;
    progress.training.push(end === "arrived" ? cycles : null);
    const key = end !== "arrived" ? "training_missed" : cycles <= limit ? "training_good" : "training_slow";
    this.note = texts.get(key, { seconds: this.seconds(cycles), limit: this.seconds(limit) });
    if (!this.isTrained && progress.training.length >= most) this.early = "untrained";
  }

  private trialTask(): TrialSpec {
    const { plan, progress, texts } = this.station;
    const position = progress.trials;
    const title = texts.get("trial_progress", { number: position + 1, count: plan.trials.length });
    return { title, task: plan.trials[position], record: { kind: "trial", position }, note: "" };
  }

  private trialDone(outcome: Outcome): void {
    const { progress, frame } = this.station;
    this.outcome = outcome;
    progress.trials += 1;
    progress.unrated = true;
    frame.occupied = true;
  }

  private rating(): Node {
    const { station } = this;
    return this.screen(async (e) => {
      const rating = await showRating(e, station, this.suggestedRating());
      station.progress.unrated = false;
      station.send({ type: "rate", rating, answers: {} });
      station.frame.occupied = false;
    });
  }

  /** Rating of a trial in a dry run; longer trials are rated as more difficult. */
  private suggestedRating(): number {
    const { rating, rate } = this.station.experiment;
    const steps = this.outcome.end === "arrived" ? Math.floor(this.outcome.cycles / rate / 10) : Infinity;
    return Math.min(rating.length - 1, steps);
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

  private seconds(cycles: number): string {
    return (cycles / this.station.experiment.rate).toFixed(1);
  }

  /** A page with one button, whose label has the key `label`. */
  private notice(key: string, testid: string, label: string): Node {
    const choices = [{ testid, label: this.station.texts.get(label) }];
    return this.screen(async (e) => void (await this.page(e, key, choices)));
  }

  private page(element: HTMLElement, key: string, choices: Choice[], last = false): Promise<string> {
    const { texts, experiment, progress, plan } = this.station;
    const { at_least, in_a_row, limit } = experiment.training;
    const values = { at_least, in_a_row, seconds: this.seconds(limit), done: progress.trials, count: plan.trials.length };
    const [title, text] = [texts.get(`${key}_title`), texts.get(`${key}_text`, values)];
    return showPage(element, this.station, { testid: key.replace("_", "-"), title, text, choices, last });
  }

  private screen(show: Show): Node {
    return { type: ScreenPlugin, show };
  }

  private task(spec: () => TrialSpec, done: (outcome: Outcome) => void): Node {
    return this.screen(async (e) => done(await performTrial(e, this.station, spec())));
  }

  private when(condition: () => boolean, timeline: Node[]): Node {
    return { timeline, conditional_function: condition };
  }
}
