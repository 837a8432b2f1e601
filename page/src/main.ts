/** The page's beginning: what the address says, what the server says, and then the session. */

import { loadArm } from "./arm";
import { h } from "./dom";
import { Robot } from "./input/robot";
import { Station } from "./station";
import { Storage } from "./storage";
import { loadExperiment } from "./experiment";
import { runSession } from "./timeline";
import "./station.css";

async function main(): Promise<void> {
  const asked = new URLSearchParams(location.search);
  const robot = asked.get("robot");
  const passed = new URLSearchParams([...asked].filter(([name]) => name === "token" || name === "robot"));
  const address = (path: string): string => {
    const url = new URL(path, location.href);
    const token = asked.get("token");
    if (token !== null) url.searchParams.set("token", token);
    return url.href;
  };
  const [experiment, arm] = await Promise.all([loadExperiment(address("experiment.json")), loadArm(address("arm.js"))]);
  const begin = `${location.pathname}${passed.size ? `?${passed}` : ""}`;
  const session = address("session").replace(/^http/, "ws");
  const seed = robot === null ? null : Number(robot) || 0;
  const storage = new Storage(robot === null ? "" : `.robot${seed}`);
  const station = new Station(experiment, arm, storage, { session, begin }, seed, asked.get("session"));
  // A key in the address would stay in the browser's history.
  if (asked.has("session")) history.replaceState(null, "", begin);
  if (seed !== null) station.device = new Robot(seed, experiment.axes, experiment.stick.limit, experiment.rate, experiment.radius);
  await runSession(station);
}

main().catch((error: unknown) => {
  const reason = error instanceof Error ? error.message : String(error);
  const text = `This page cannot start: ${reason}. Reload it, or ask the experimenter.`;
  document.getElementById("app")?.append(h("p", { class: "failure" }, text));
});
