/** The screens of a session in their order, without the parts that were done in an earlier visit. */

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
  await new Session(station).run();
}

class Session {
  /** Reason why the session ends early; null if it does not. */
  private early: "declined" | "untrained" | null = null;
  /** Practice tasks done. */
  private practised = 0;
  private note = "";
  private outcome: Outcome = { end: "arrived", cycles: 0 };

  constructor(private readonly station: Station) {}

  async run(): Promise<void> {
    const { station } = this;
    await showSetup(this.stage, station);
    await showJoin(this.stage, station);
    this.joined();
    await this.form("consent", "declined");
    await this.form("demographics");
    if (this.untouched) await showInstructions(this.stage, station);
    if (this.untouched) await this.practice();
    await this.training();
    await this.trials();
    if (station.experiment.tlx) await this.form("tlx");
    await this.debriefing();
  }

  // ---- the parts of the session ------------------------------------------------------------------------------------

  private joined(): void {
    const { station } = this;
    if (station.device) station.event("input", { device: station.device.kind, ...station.device.about?.() });
    if (station.progress.over && this.more) this.early = "untrained";
  }

  private async form(name: string, onDecline: "declined" | null = null): Promise<void> {
    const { station } = this;
    const form = station.experiment.forms.find((f) => f.name === name);
    if (form === undefined || this.early !== null || station.progress.answered.has(name)) return;
    station.frame.progress(form.title);
    const answers = await showForm(this.stage, station, form);
    if (answers !== null) return station.answer(name, answers);
    this.early = onDecline;
    station.event("declined", { form: name });
  }

  /** Practice uses training tasks from the end of the plan, which few subjects reach; it is not recorded. */
  private async practice(): Promise<void> {
    const choices = ["done", "more"].map((name) => this.choice(`practice-${name}`, `practice_${name}`));
    for (let asked = ""; asked !== "practice-done"; ) {
      await this.perform(this.practiceTask());
      this.practised++;
      if (this.practised >= PRACTICE) asked = await this.page("practice", choices);
    }
  }

  private async training(): Promise<void> {
    const wanted = (): boolean => !this.isTrained && this.early === null;
    if (wanted() && this.station.progress.training.length === 0) await this.notice("training_intro", "training-begin", "go_on");
    while (wanted()) this.trainingDone(await this.perform(this.trainingTask()));
  }

  private async trials(): Promise<void> {
    const { progress } = this.station;
    if (this.early === null && progress.unrated) await this.rating();
    if (this.more && progress.trials === 0) await this.notice("trials_intro", "trials-begin", "go_on");
    while (this.more) {
      this.trialDone(await this.perform(this.trialTask()));
      await this.rating();
      if (this.more && progress.trials % BREAK_EVERY === 0) await this.notice("break", "break-over", "break_over");
    }
  }

  private async debriefing(): Promise<void> {
    const { station } = this;
    station.frame.progress("");
    const stored = station.finish();
    await this.page(this.early ?? "debriefing", [this.choice("next-subject", "next_subject")], true);
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
    frame.set({ occupied: true });
  }

  private async rating(): Promise<void> {
    const { station } = this;
    const rating = await showRating(this.stage, station, this.suggestedRating());
    station.progress.unrated = false;
    station.send({ type: "rate", rating, answers: {} });
    station.frame.set({ occupied: false });
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

  private choice(testid: string, label: string): Choice {
    return { testid, label: this.station.texts.get(label) };
  }

  /** A page with one button, whose label has the key `label`. */
  private async notice(key: string, testid: string, label: string): Promise<void> {
    await this.page(key, [this.choice(testid, label)]);
  }

  private page(key: string, choices: Choice[], last = false): Promise<string> {
    const { texts, experiment, progress, plan } = this.station;
    const { at_least, in_a_row, limit } = experiment.training;
    const values = { at_least, in_a_row, seconds: this.seconds(limit), done: progress.trials, count: plan.trials.length };
    const [title, text] = [texts.get(`${key}_title`), texts.get(`${key}_text`, values)];
    return showPage(this.stage, this.station, { testid: key.replace("_", "-"), title, text, choices, last });
  }

  private perform(spec: TrialSpec): Promise<Outcome> {
    return performTrial(this.stage, this.station, spec);
  }

  /** Where the next screen is shown, from its top. */
  private get stage(): HTMLElement {
    const { stage } = this.station.frame;
    stage.scrollTop = 0;
    return stage;
  }
}
