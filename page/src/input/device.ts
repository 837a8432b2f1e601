/** What holds the arm's stick: a gamepad, the mouse, the keys, or a simulated person. */

import type { View } from "../experiment";

export type Kind = "gamepad" | "pointer" | "keys" | "robot";

/** What is to be seen when a control cycle begins. */
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
  /** Whether the trigger has been pressed since the last call. */
  triggered(): boolean;
  /** Whether the device is gone. */
  lost(): boolean;
  /** What is written into the records about it. */
  about(): Record<string, string | number>;
  /** Take a window as a surface; the centre of the stick is its middle. `reach`: pixels to full deflection. */
  attach?(surface: HTMLElement, view: View, reach: () => number): void;
  /** Forget the windows. */
  detach?(): void;
  /** A trial begins. */
  begin?(): void;
  /** A control cycle begins. */
  see?(scene: Scene): void;
  /** Wants to give the trial up: only a robot does so by itself. */
  readonly tired?: boolean;
  /** Stop listening to anything. */
  release(): void;
}
