/** Controls for all subjects: data folder, pause, dry run, tables, report. */

import { button, h } from "../dom";
import type { About, Server } from "./server";
import { texts } from "./texts";

/** A link that opens in a new tab. */
function opener(testid: string, label: string, help: string, href = ""): HTMLAnchorElement {
  return h("a", { class: "button second", target: "_blank", rel: "noopener", "data-testid": testid, title: help, href }, label);
}

export class Top {
  readonly element: HTMLElement;
  private paused = false;
  private readonly line = h("span", { class: "line", role: "status", "data-testid": "connection", "data-online": "none" });
  private readonly pause: HTMLButtonElement;
  private readonly banner = h("p", { class: "banner", role: "status", "data-testid": "all-paused", hidden: true }, texts.allPaused);
  private readonly fault = h("p", { class: "banner fault", role: "alert", "data-testid": "fault", hidden: true });

  constructor(server: Server, about: About, name: string, say: (text: string) => void) {
    const togglePause = (): void => {
      say("");
      server.post("pause", { subject: null, paused: !this.paused }).catch((error: Error) => say(error.message));
    };
    this.pause = button("pause-all", texts.pauseAll, togglePause, "second");
    const header = h("header", {}, h("span", { class: "name" }, `${texts.title}: ${name}`), this.line);
    const tables = opener("export", texts.export, texts.exportHelp, server.address("/experimenter/export.zip"));
    const tools = h("div", { class: "tools" }, this.pause, this.dryRun(about), tables, this.report(server));
    const folder = h("code", { "data-testid": "folder" }, about.folder);
    const station = h("code", { "data-testid": "station-url" }, about.station);
    const where = h("p", { class: "where" }, `${texts.folder} `, folder, ` \u00b7 ${texts.station} `, station);
    this.element = h("div", { class: "top" }, header, tools, where, this.banner, this.fault);
  }

  online(yes: boolean): void {
    this.line.dataset.online = String(yes);
    this.line.textContent = yes ? texts.online : texts.offline;
    this.line.title = yes ? "" : texts.offlineHelp;
  }

  show(paused: boolean, fault: string | null): void {
    this.fault.hidden = fault === null;
    this.fault.textContent = fault === null ? "" : `${texts.fault} ${fault}`;
    this.paused = paused;
    this.pause.textContent = paused ? texts.resumeAll : texts.pauseAll;
    this.pause.setAttribute("aria-pressed", String(paused));
    this.banner.hidden = !paused;
  }

  private dryRun(about: About): HTMLElement {
    const seed = h("input", { id: "seed", type: "number", min: 0, max: 999999, step: 1, value: 1, "data-testid": "robot-seed" });
    const link = opener("dry-run", texts.dryRun, texts.dryRunHelp);
    const address = (): void => {
      const url = new URL(about.station);
      url.searchParams.set("robot", String(Math.trunc(Number(seed.value)) || 0));
      link.href = url.href;
    };
    seed.addEventListener("input", address);
    // The next dry run uses another operator.
    link.addEventListener("click", () =>
      setTimeout(() => {
        seed.value = String(Number(seed.value) + 1);
        address();
      }),
    );
    address();
    return h("span", { class: "tool" }, link, h("label", { for: "seed" }, texts.seed), seed);
  }

  private report(server: Server): HTMLElement {
    const link = opener("report", texts.report, texts.reportHelp);
    const options = Object.entries(texts.missingChoices).map(([value, label]) => h("option", { value }, label));
    const missing = h("select", { id: "missing", "data-testid": "report-missing" }, ...options);
    const address = (): void => void (link.href = server.address("/experimenter/report", { missing: missing.value }));
    missing.addEventListener("change", address);
    address();
    return h("span", { class: "tool" }, link, h("label", { for: "missing" }, texts.missing), missing);
  }
}
