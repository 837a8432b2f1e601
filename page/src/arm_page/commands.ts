/** Commands and Python lines that reproduce what the page shows. */

import { h } from "../dom";
import type { Vector } from "../viewer/scene";
import { listJoints, type PageState } from "./address";
import type { ArmPageData } from "./data";

/** Code that reproduces a state. */
export interface Code {
  kind: "studio" | "shell" | "python";
  text: string;
}

/**
 * Return the command and the Python lines for the numbers of a state; `worst` is the joint with the worst bar, from 0, and
 * `target` the target of the undetected lock, m.
 */
export function reproduce(data: ArmPageData, state: PageState, worst: number, target: Vector): Code[] {
  const q = Array.from(state.q, (value) => String(Number(value.toFixed(6)))).join(", ");
  const numbers = `"${q.replace(/ /g, "")}"`;
  const failed = listJoints(state.conditions, "locked", "free");
  const free = listJoints(state.conditions, "free");
  const code = (shell: string, ...lines: string[]): Code[] => [
    { kind: "shell", text: shell },
    { kind: "python", text: ["import holdfast as hf", "", `arm = ${data.pythonArm}`, `q = [${q}]`, ...lines].join("\n") },
  ];
  const measure = `hf.indices.relative_manipulability(arm, "${data.taskName}")`;
  const indexCommand = `holdfast index ${data.argument} --q=${numbers} --task ${data.taskName}`;
  const index = code(indexCommand, `print(${measure}.evaluate(q).by_failure)`);
  const { step } = state;
  if (step === "healthy" || step === "lock") {
    if (data.scene.joints.length <= data.taskRows.length) return code(`holdfast describe ${data.argument}`, "print(arm)");
    if (step === "healthy" || failed.length < 2) return index;
    return code(
      indexCommand,
      "import numpy as np",
      `from holdfast.model.arm.task import as_task`,
      "",
      `J = as_task(arm, "${data.taskName}").rows @ arm.jacobian(q)`,
      "N = np.linalg.svd(J)[2][len(J):].T",
      `print(np.linalg.svd(N[[${failed.join(", ")}]])[1])`,
    );
  }
  if (step === "prepare" && !failed.length) {
    return code(
      `holdfast optimise ${data.argument} --at=${numbers} --maximise relative-manipulability --task ${data.taskName}`,
      `print(hf.optimise(arm, arm.forward_kinematics(q), ${measure}, initial=q).value)`,
    );
  }
  if (step === "undetected" && data.story !== null) {
    const { laws, gain, speed } = data.story;
    const locked = failed[0] ?? worst;
    const task = data.positionTask;
    const goal = target.slice(0, task === "planar" ? 2 : 3).map((value) => Number(value.toFixed(6)));
    const simulate = (law: string): string =>
      `holdfast simulate ${data.argument} --start=${numbers} --task ${task} --target=${goal.join(",")} ` +
      `--lock ${locked + 1} --law ${law} --gain ${gain} --speed-limit ${speed}`;
    return code(
      laws.map(({ slug }) => simulate(slug)).join("\n"),
      `for label in ["${laws[0].slug}", "${laws[1].slug}"]:`,
      `    law = hf.laws.by_name(label, arm, task="${task}", gain=${gain}, speed_limit=${speed})`,
      `    print(hf.simulate(law, q, [${goal.join(", ")}], locked=[${locked}]).line_deviation(until=12))`,
    );
  }
  if (step === "power") {
    const seconds = state.brakeDelay / 1000;
    const joints = free.length ? ` --free ${free.map((joint) => joint + 1).join(",")}` : "";
    const option = free.length ? `, free=[${free.join(", ")}]` : "";
    const swing = free.length === 1 ? `\nholdfast susceptibility ${data.argument} --measure swing-angle --q=${numbers}` : "";
    return code(
      `holdfast power-loss ${data.argument} --q=${numbers}${joints} --coulomb 0 --stiction 0 ` +
        `--duration ${Math.max(seconds, 0.01)}${swing}`,
      `fall = hf.power_loss(arm, q${option}, friction=hf.Friction(coulomb=0), duration=0.5)`,
      `print(fall.drop_at(${seconds}))`,
    );
  }
  return index;
}

/** Show commands and Python lines, each with a button that copies it, and a button for the address. */
export function writeCommands(details: HTMLElement, texts: Record<string, string>, list: Code[]): void {
  const status = h("span", { role: "status" });
  const copy = (text: () => string, label: string): HTMLButtonElement =>
    h("button", { type: "button", onclick: () => void copyText(text()).then(() => (status.textContent = texts.copied)) }, label);
  const blocks = list.flatMap(({ kind, text }) => [
    h("pre", { tabindex: 0, class: `command-${kind}` }, text),
    copy(() => text, texts[`copy_${kind}`]),
  ]);
  const address = copy(() => location.href, texts.copy_address);
  details.replaceChildren(h("summary", {}, texts.commands), ...blocks, " ", address, status);
}

/** Copy a text, also in a page that has no clipboard, for example in a sandboxed frame. */
async function copyText(text: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = h("textarea", { class: "visually-hidden" });
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
  }
}
