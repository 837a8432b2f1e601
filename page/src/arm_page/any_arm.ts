/** Shows an arm of a URDF file, from the menu or from the visitor, as sticks; it runs before the page starts. */

import { createFilePicker, h, setText } from "../dom";
import { Random } from "../random";
import { place, size, sum } from "../viewer/algebra";
import type { Part, Scene, Vector } from "../viewer/scene";
import { ArmModel, GENERIC_JOINTS } from "./arm_model";
import type { ArmPageData, PrintedKernels } from "./data";
import { fillText, formatPercent } from "./phrases";
import { traceSelfMotion } from "./self_motion";
import { readUrdf, type UrdfArm } from "./urdf";

type ArmFile = Pick<ArmPageData, "name" | "argument" | "pythonArm"> & { urdf: string };

declare const armKernels: Record<string, PrintedKernels>;
/** Kernels for any arm, and the files of the menu by the names of their arms. */
declare const anyArm: { kernels: PrintedKernels; files: Record<string, ArmFile> };

const START_COUNT = 24;
const NO_LIMIT_RAD = 1e6;
const LINK_RADIUS_FRACTION = 0.017; // this and the colours as in body.py
const LINK_COLOR: Vector = [201, 208, 214];
const JOINT_COLOR: Vector = [72, 84, 96];

/** Make the section of the page for an arm from that of the first arm. */
function createSection({ urdf, ...names }: ArmFile): HTMLElement {
  const section = first.cloneNode(true) as HTMLElement;
  const find = (selector: string): HTMLElement => section.querySelector(selector) as HTMLElement;
  const write = (selector: string, value: unknown): void => setText(find(selector), JSON.stringify(value));
  const arm = readUrdf(urdf);
  const { joints, tool } = arm;
  armKernels[names.name] = { ...anyArm.kernels, geometry: listGeometry(arm) };
  const model = new ArmModel(armKernels[names.name], joints, data.taskRows);
  const [q, target] = chooseStart(model);
  const jointLabels = joints.map((_, k) => `joint ${k + 1}`);
  const bound = Math.sqrt(model.redundancy / joints.length);
  const story = data.story && { ...data.story, start: q, target, motions: 0 };
  write(".arm-data script", { ...data, ...names, jointLabels, bound, story });

  const length = [...joints.slice(1).map(({ origin }) => origin), tool].reduce((total, pose) => total + size(place(pose)), 0);
  const points = model.frames(q).map((pose) => place([...pose]));
  const center = points.reduce((middle, point) => sum(middle, point, 1 / points.length), [0, 0, 0]);
  const radius = 1.2 * Math.max(...points.map((point) => size(sum(point, center, -1))));
  const scene = JSON.parse(find(".view3d > script").textContent ?? "") as Scene;
  const picture = { up: [0, 0, 1], size: length, camera: { ...scene.camera, center, radius }, objects: [], lost: [] };
  write(".view3d > script", { ...scene, ...arm, ...picture, locked: joints.map(() => null), arms: [{ label: "", q: [q] }] });
  write(".view3d-body script", listSticks(arm, LINK_RADIUS_FRACTION * length));

  for (const element of section.querySelectorAll(".view3d-stage svg, .view3d-note")) element.remove();
  for (const element of section.querySelectorAll(".view3d, canvas")) element.setAttribute("aria-label", names.name);
  const bars = find(".bars");
  bars.replaceChildren(...joints.map(() => bars.children[0].cloneNode(true)));
  bars.querySelectorAll<HTMLElement>(".bar-name").forEach((name, k) => setText(name, jointLabels[k]));
  bars.style.setProperty("--bound", String(bound));
  const note = fillText(data.texts.bound, { count: joints.length, bound: formatPercent(bound) });
  setText(find(".bars-note"), `${data.texts.bars}${bound ? `; ${note}` : ""}`);
  return section;
}

/** List the geometry that the kernels for any arm read; the joints that the arm does not have are at the tool point. */
function listGeometry({ joints, tool }: UrdfArm): Float64Array {
  const missing = Array.from({ length: GENERIC_JOINTS - joints.length }, () => 0);
  const poses = [...joints.map(({ origin }) => origin), tool, ...missing.map(() => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0])];
  const limits = [joints.map(({ low }) => low ?? -NO_LIMIT_RAD), joints.map(({ high }) => high ?? NO_LIMIT_RAD)];
  return Float64Array.from([...poses, ...[...limits, joints.map(() => 1)].map((values) => [...values, ...missing])].flat());
}

/** Choose, near the middle of the limits, a configuration that its self-motion improves most, and a target position. */
function chooseStart(arm: ArmModel): [number[], Vector] {
  const random = new Random(1);
  const middle = arm.joints.map(({ low, high }) => ((low ?? -Math.PI) + (high ?? Math.PI)) / 2);
  const motions = Array.from({ length: START_COUNT }, () =>
    traceSelfMotion(arm, arm.restrict(Float64Array.from(middle, (value) => value + 2 * random.uniform() - 1))));
  const [best, next] = motions.sort((a, b) => b.worst[b.best] - b.worst[b.start] - a.worst[a.best] + a.worst[a.start]);
  return [[...best.configurations[best.start]], arm.toolPosition(next.configurations[next.start])];
}

/** Tubes for the links and the joints. */
function listSticks({ joints, tool }: UrdfArm, radius: number): Part[] {
  const ends = [...joints.map(({ origin }) => origin), tool].map(place);
  const scale = (part: number): number => part * radius;
  return [
    { frame: 0, color: JOINT_COLOR, tube: [0, 0, -0.3, 0, 0, 0, 4.5].map(scale) },
    ...ends.map((end, frame) => ({ frame, color: LINK_COLOR, tube: [0, 0, 0, ...end, radius], round: true })),
    ...joints.map((_, k) => ({ frame: k + 1, color: JOINT_COLOR, joint: k, tube: [0, 0, -1.9, 0, 0, 1.9, 1.75].map(scale) })),
  ];
}

async function openFile(file: File): Promise<void> {
  const { name } = file;
  try {
    const urdf = await file.text();
    const { tip } = readUrdf(urdf);
    const [path, link] = [name, tip].map((word) => `'${word.replaceAll("'", "'\\''")}'`);
    const pythonArm = `hf.arms.load(${JSON.stringify(name)}, tip=${JSON.stringify(tip)})`;
    if (!Object.hasOwn(anyArm.files, name)) menu.append(h("option", { value: name }, name));
    anyArm.files[name] = { name, argument: `${path} --tip ${link}`, pythonArm, urdf };
    menu.value = name;
    menu.dispatchEvent(new Event("change"));
    setText(status, fillText(data.texts.urdf_opened, { name, tip }));
  } catch (error) {
    setText(status, fillText(data.texts.urdf_refused, { name, reason: (error as Error).message }));
  }
}

const menu = document.querySelector(".arm-menu") as HTMLSelectElement;
const first = (document.querySelector(".arm") as HTMLElement).cloneNode(true) as HTMLElement;
const data = JSON.parse(first.querySelector(".arm-data script")?.textContent ?? "") as ArmPageData;
const status = h("p", { role: "status" });
menu.addEventListener("change", () => {
  setText(status, "");
  const file = anyArm.files[menu.value];
  document.querySelector(".arm")?.replaceWith(file ? createSection(file) : first.cloneNode(true));
});
const asked = new URLSearchParams(location.hash.slice(1)).get("arm") ?? "";
if (Object.hasOwn(anyArm.files, asked)) menu.value = asked;
if (menu.selectedIndex) menu.dispatchEvent(new Event("change"));
menu.parentElement?.after(createFilePicker(data.texts.urdf_open, ".urdf,.xml", (file) => void openFile(file)), status);
