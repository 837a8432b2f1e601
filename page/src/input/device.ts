/** Input device for the arm: a gamepad, the mouse, the keys, or a simulated person. */

import type { View } from "../experiment";

export type Kind = "gamepad" | "pointer" | "keys" | "robot";

/** State at the beginning of a control cycle. */
export interface Scene {
  cycle: number;
  /** Tool point and target, m. */
  x: ArrayLike<number>;
  target: ArrayLike<number>;
}

export interface Device {
  readonly kind: Kind;
  /** The deflection now, -1 to 1 on each axis of the task. */
  read(out: Float64Array): void;
  /** True if the trigger has been pressed since the last call. The space bar starts a trial with every device. */
  triggered?(): boolean;
  /** True if the device was disconnected. */
  lost?(): boolean;
  /** Details of the device for the records. */
  about?(): Record<string, string | number>;
  /** Take a velocity window as a surface; the centre of the stick is its middle. */
  attach?(surface: SVGElement, view: View): void;
  /** Forget the windows. */
  detach?(): void;
  /** A trial begins. */
  begin?(): void;
  /** A control cycle begins. */
  see?(scene: Scene): void;
  /** True if the simulated person wants to give up the trial. */
  readonly tired?: boolean;
  /** Stop listening to anything. */
  release?(): void;
}
