/** Choose what holds the stick, see it move, and calibrate a gamepad. */

import { button, card, h, option, setText } from "../dom";
import type { Calibration } from "../input/calibration";
import type { Device } from "../input/device";
import { Pad, pads } from "../input/gamepad";
import { Keys } from "../input/keys";
import { Pointer } from "../input/pointer";
import type { Station } from "../station";
import { Wizard } from "./wizard";
import { VelocityWindows } from "./windows";

type Kind = "gamepad" | "pointer" | "keys";
const KINDS: Kind[] = ["gamepad", "pointer", "keys"];

/** Resolved when the person continues; the station has its device then. */
export function showSetup(element: HTMLElement, station: Station): Promise<void> {
  return new Promise((resolve) => new Setup(element, station, resolve).show());
}

class Setup {
  private kind: Kind = "pointer";
  /** The person has chosen: a gamepad that turns up changes nothing any more. */
  private chosen = false;
  private wizard: Wizard | null = null;
  private over = false;
  private readonly velocities: VelocityWindows;
  private readonly found = h("p", { class: "found", "aria-live": "polite", "data-testid": "gamepad-found" });
  private readonly how = h("p", { class: "message", "aria-live": "polite", "data-testid": "setup-message" });
  private readonly inputs: HTMLInputElement[];
  private readonly next: HTMLButtonElement;
  private readonly calibrate: HTMLButtonElement;

  constructor(
    private readonly element: HTMLElement,
    private readonly station: Station,
    private readonly resolve: () => void,
  ) {
    const { texts, arm } = station;
    this.velocities = new VelocityWindows(station);
    this.inputs = KINDS.map((kind) => {
      const input = h("input", { type: "radio", name: "device", value: kind, "data-testid": `device-${kind}` });
      input.addEventListener("change", () => {
        this.chosen = true;
        this.choose(kind);
      });
      return input;
    });
    this.next = button("setup-continue", texts.get("setup_continue"), () => this.done());
    this.calibrate = button("calibrate", texts.get("setup_calibrate"), () => (this.wizard = new Wizard(arm.axes)), "second");
  }

  show(): void {
    const { texts, experiment } = this.station;
    const options = KINDS.map((kind, i) => {
      const name = h("b", {}, texts.get(`device_${kind}`));
      const help = h("small", {}, texts.get(`device_${kind}_help`));
      return option(this.inputs[i], name, help, kind === "gamepad" ? this.found : null);
    });
    const trial = h("div", { class: "try", "data-views": experiment.views.length }, ...this.velocities.elements, this.how);
    const columns = h("div", { class: "columns" }, h("div", { class: "options" }, ...options), trial);
    const buttons = h("div", { class: "buttons" }, this.next, this.calibrate);
    const properties = { class: "card wide setup", "data-testid": "setup" };
    this.element.replaceChildren(
      card("section", properties, texts.get("setup_title"), texts.get("setup_text"), columns, buttons),
    );
    this.choose(pads().length ? "gamepad" : "pointer");
    this.next.focus({ preventScroll: true });
    const frame = (): void => {
      if (this.over) return;
      this.look();
      requestAnimationFrame(frame);
    };
    frame();
    this.station.auto(() => this.done());
  }

  private choose(kind: Kind): void {
    const { station } = this;
    this.kind = kind;
    this.wizard = null;
    this.inputs[KINDS.indexOf(kind)].checked = true;
    if (station.robot === null) {
      station.device?.detach?.();
      station.device?.release?.();
      station.device = this.device(kind);
    }
    this.velocities.attach(station);
    this.how.textContent = station.texts.get(`try_${kind}`);
    this.calibrate.hidden = kind !== "gamepad";
    // On one of the choices the arrow keys would choose another one.
    if (kind === "keys") this.next.focus({ preventScroll: true });
  }

  private device(kind: Kind): Device | null {
    if (kind === "pointer") return new Pointer();
    if (kind === "keys") return new Keys();
    const [pad] = pads();
    if (pad === undefined) return null;
    const own = this.station.storage.read<Calibration>(`device.${pad.id}`);
    const axes = this.station.arm.axes;
    return new Pad(pad.id, axes, own !== null && own.axes.length === axes ? own : undefined);
  }

  private look(): void {
    const { station } = this;
    const { texts } = station;
    const [pad] = pads();
    setText(this.found, pad === undefined ? texts.get("gamepad_none") : texts.get("gamepad_found", { id: pad.id }));
    const wanted = this.kind === "gamepad" ? station.device === null : !this.chosen;
    if (pad !== undefined && wanted) this.choose("gamepad");
    this.calibrate.disabled = station.device === null || station.device.lost?.() === true;
    this.next.disabled = this.wizard !== null || this.calibrate.disabled;
    if (this.wizard !== null && pad !== undefined) this.step(pad);
    this.velocities.drawCommand(station.stick, station.device);
  }

  private step(pad: Gamepad): void {
    const { station, wizard } = this;
    if (wizard === null || !(station.device instanceof Pad)) return;
    const pressed = pad.buttons.map((b) => b.pressed);
    const said = station.texts.get(wizard.look(pad.axes, pressed, performance.now() / 1000));
    setText(this.how, said);
    if (wizard.result === null) return;
    station.device.calibration = wizard.result;
    station.storage.write(`device.${pad.id}`, wizard.result);
    this.wizard = null;
    this.how.textContent = station.texts.get("calibrate_done");
    this.next.disabled = false;
    this.next.focus({ preventScroll: true });
  }

  private done(): void {
    if (this.over || this.station.device === null) return;
    this.over = true;
    this.station.device.detach?.();
    this.resolve();
  }
}
