/** The arm of a URDF file, with its fixed joints merged; holdfast/model/arm/formats/urdf.py reads the same numbers. */

import { across, cross, inverse, rotation, size, times, unit } from "../viewer/algebra";
import type { Chain, Joint, Pose, Vector } from "../viewer/scene";

const FINGER = /finger|thumb|pinky|knuckle|jaw|claw|grip/i; // this and the next as in tree.py
const TOOL = /tool|tcp|flange|grasp|effector/i;
const JOINT_COUNTS = [6, 7, 8, 9];
const FARTHEST_LIMIT_RAD = 200 * Math.PI;
const QUARTER_TURN_TOLERANCE_RAD = 1e-9;
const IDENTITY: Pose = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/** Revolute joints about the z axes of their frames, and the link whose frame is the tool. */
export type UrdfArm = Chain & { tip: string };

/** Read an arm, or throw an error whose message begins a sentence. */
export function readUrdf(text: string): UrdfArm {
  const file = new DOMParser().parseFromString(text.trimStart(), "application/xml");
  const robot = file.documentElement;
  if (file.doctype || file.querySelector("parsererror") || robot.tagName !== "robot") throw new Error("It is not a URDF file");
  const path = findChain([...robot.children]);
  const joints: Joint[] = [];
  let pose = IDENTITY; // in the frame of the last joint
  for (const joint of path) {
    pose = times(pose, readOrigin(joint));
    const [name, type] = [readAttribute(joint), readAttribute(joint, "type")];
    if (type === "fixed") continue;
    if (!isRevolute(joint)) throw new Error(`Joint ${name} is ${child(joint, "mimic") ? "a mimic joint" : type}, not revolute`);
    const axis = unit(readNumbers(joint, "axis", "xyz", "1 0 0", 3) as Vector);
    if (!size(axis)) throw new Error(`The axis of joint ${name} is 0 0 0`);
    const [first, second] = [across(axis), cross(axis, across(axis))];
    const toAxis = [0, 1, 2].flatMap((k) => [first[k], second[k], axis[k], 0]);
    const [low, high] = type === "revolute" ? readLimits(joint) : [null, null];
    joints.push({ name, origin: times(pose, toAxis), axis: [0, 0, 1], slides: false, low, high });
    pose = inverse(toAxis);
  }
  if (!JOINT_COUNTS.includes(joints.length)) throw new Error(`The page needs 6 to 9 revolute joints, not ${joints.length}`);
  return { base: IDENTITY, joints, tool: pose, tip: linkOf(path[path.length - 1], "child") };
}

const child = (element: Element, tag: string): Element | undefined => [...element.children].find((e) => e.tagName === tag);
const readAttribute = (element: Element | undefined, attribute = "name"): string => element?.getAttribute(attribute) ?? "";
const linkOf = (joint: Element, role: string): string => readAttribute(child(joint, role), "link");
const isRevolute = (joint: Element): boolean => /^(revolute|continuous)$/.test(readAttribute(joint, "type")) && !child(joint, "mimic");

/**
 * Find the joints from the root to a tip, without fingers. The chain with the most revolute joints is chosen, among these one to
 * a link that is named as a tool, then the longest.
 */
function findChain(elements: Element[]): Element[] {
  const joints = elements.filter(({ tagName }) => tagName === "joint");
  const children = new Set(joints.map((joint) => linkOf(joint, "child")));
  const roots = elements.filter((element) => element.tagName === "link" && !children.has(readAttribute(element)));
  if (roots.length !== 1 || children.size !== joints.length) throw new Error("Its links do not form one tree");
  let [chain, highest]: [Element[], number] = [[], 0];
  const walk = (link: string, path: Element[], rank: number): void => {
    const score = rank + (TOOL.test(link) ? 1e3 : 0);
    if (score > highest) [chain, highest] = [path, score];
    for (const joint of joints.filter((each) => linkOf(each, "parent") === link)) {
      const [next, weight] = [linkOf(joint, "child"), isRevolute(joint) ? 1e6 : readAttribute(joint, "type") === "fixed" ? 1 : -1e4];
      if (!FINGER.test(`${readAttribute(joint)} ${next}`)) walk(next, [...path, joint], rank + weight);
    }
  };
  walk(readAttribute(roots[0]), [], 0);
  return chain;
}

function readNumbers(joint: Element, tag: string, attribute: string, missing: string, count: number): number[] {
  const text = child(joint, tag)?.getAttribute(attribute) ?? missing;
  const values = text.trim().split(/\s+/).map((word) => (word ? Number(word) : NaN));
  if (values.length !== count || !values.every(Number.isFinite)) throw new Error(`It has "${text}" in place of ${count} numbers`);
  return values;
}

/** Read the pose of a joint; an angle near a quarter turn is meant to be one. */
function readOrigin(joint: Element): Pose {
  const [x, y, z] = readNumbers(joint, "origin", "xyz", "0 0 0", 3);
  const [roll, pitch, yaw] = readNumbers(joint, "origin", "rpy", "0 0 0", 3).map((angle) => {
    const nearest = (Math.round(angle / (Math.PI / 2)) * Math.PI) / 2;
    return Math.abs(angle - nearest) < QUARTER_TURN_TOLERANCE_RAD ? nearest : angle;
  });
  const rotated = times(rotation([0, 0, 1], yaw), times(rotation([0, 1, 0], pitch), rotation([1, 0, 0], roll)));
  return times([1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z], rotated);
}

function readLimits(joint: Element): (number | null)[] {
  const [low, high] = ["lower", "upper"].map((key) => readNumbers(joint, "limit", key, "0", 1)[0]);
  const isGiven = ["lower", "upper"].some((key) => child(joint, "limit")?.hasAttribute(key));
  if (!isGiven || low > high) throw new Error(`Joint ${readAttribute(joint)} needs a lower limit below its upper limit`);
  return [low, high].map((value) => (Math.abs(value) > FARTHEST_LIMIT_RAD ? null : value));
}
