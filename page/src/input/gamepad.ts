/** A gamepad or joystick, as the browser shows it. */

import { deflection, standard, type Calibration } from "./calibration";
import type { Device } from "./device";

/** The gamepads that are there. A browser shows none before one of its buttons is pressed. */
export function pads(): Gamepad[] {
  // Some browsers have no gamepads at all on a page that came without TLS from another computer.
  const all = "getGamepads" in navigator ? navigator.getGamepads() : [];
  return all.filter((pad): pad is Gamepad => pad !== null && pad.connected && pad.axes.length >= 2);
}

export class Pad implements Device {
  readonly kind = "gamepad";
  private held = true;

  /**
   * @param id of the device
   * @param calibration its own; the standard one if null
   */
  constructor(
    readonly id: string,
    axes: number,
    public calibration: Calibration = standard(axes),
  ) {}

  get raw(): Gamepad | undefined {
    return pads().find((pad) => pad.id === this.id);
  }

  read(out: Float64Array): void {
    const pad = this.raw;
    if (pad === undefined) out.fill(0);
    else deflection(this.calibration, pad.axes, out);
  }

  triggered(): boolean {
    const pad = this.raw;
    const pressed = pad !== undefined && this.calibration.start.some((b) => pad.buttons[b]?.pressed);
    const fresh = pressed && !this.held;
    this.held = pressed;
    return fresh;
  }

  lost(): boolean {
    return this.raw === undefined;
  }

  about(): Record<string, string | number> {
    const of = (a: Calibration["axes"][number]): string =>
      `${a.axis}: ${a.centre.toFixed(4)} ${a.range.toFixed(4)} ${a.noise.toFixed(4)}`;
    const axes = Object.fromEntries(this.calibration.axes.map((a, i) => [`axis${i + 1}`, of(a)]));
    return { id: this.id.slice(0, 200), ...axes };
  }

  begin(): void {
    this.held = true;
  }
}
