/** The experimenter's page: all subjects, their present activity, and the actions of the experimenter. */

import { loadArm } from "../arm";
import { h } from "../dom";
import { loadExperiment } from "../experiment";
import { LiveView } from "./live";
import { Panel } from "./panel";
import { Server, type Cycle, type State } from "./server";
import { Table } from "./table";
import { texts } from "./texts";
import { Top } from "./top";
import "../station.css";
import "./experimenter.css";

/** Time without a cycle after which a subject counts as not steering, ms. */
const STILL = 1500;

class Page {
  private chosen: string | null = null;
  private readonly cycles = new Map<string, { cycle: Cycle; at: number }>();

  constructor(
    private readonly top: Top,
    private readonly table: Table,
    private readonly panel: Panel,
    private state: State,
  ) {}

  readonly choose = (code: string): void => {
    this.chosen = code;
    this.show();
  };

  run(server: Server): void {
    this.show();
    setInterval(() => this.show(), 500);
    server.watch({
      online: (yes) => this.top.online(yes),
      state: (state) => {
        this.state = state;
        this.show();
      },
      cycle: (cycle) => {
        const first = !this.steering(cycle.subject);
        this.cycles.set(cycle.subject, { cycle, at: performance.now() });
        // The first subject that moves is shown until a subject is chosen.
        this.chosen ??= cycle.subject;
        if (first) this.show();
        else if (cycle.subject === this.chosen) this.showPanel();
      },
    });
  }

  private readonly steering = (code: string): boolean => performance.now() - (this.cycles.get(code)?.at ?? -Infinity) < STILL;

  private show(): void {
    this.top.show(this.state.paused, this.state.fault);
    this.table.show(this.state.subjects, this.steering, this.chosen);
    this.showPanel();
  }

  private showPanel(): void {
    const code = this.chosen;
    const subject = this.state.subjects.find((s) => s.subject === code) ?? null;
    const cycle = code === null ? null : (this.cycles.get(code)?.cycle ?? null);
    this.panel.show(subject, this.state.paused, cycle, code !== null && this.steering(code));
  }
}

async function main(): Promise<void> {
  const server = new Server();
  const [about, experiment, arm] = await Promise.all([
    server.about(),
    loadExperiment(server.address("/experiment.json")),
    loadArm(server.address("/arm.js")),
  ]);
  document.title = `${texts.title}: ${about.name}`;
  const failure = h("p", { class: "said", role: "alert", "data-testid": "failure", "data-bad": "true" });
  const top = new Top(server, about, about.name, (said) => (failure.textContent = said));
  const panel = new Panel(server, new LiveView(experiment, arm, about));
  const table = new Table((code) => page.choose(code));
  const page = new Page(top, table, panel, about);
  document.getElementById("app")?.replaceChildren(top.element, failure, h("main", {}, table.element, panel.element));
  page.run(server);
}

main().catch((error: unknown) => {
  const reason = error instanceof Error ? error.message : String(error);
  document.getElementById("app")?.append(h("p", { class: "failure" }, `${texts.failed} ${reason}`));
});
