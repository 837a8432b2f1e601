/**
 * A simulated person for dry runs, marked as such: reacts after a while, with a lag, with noise that grows with the
 * command, slows down towards the target, and tries another direction when it gets nowhere. After
 * `holdfast.teleop.trials.operators`, with the typical person's parameters.
 */

import { Random } from "../random";
import { norm } from "../stick";
import type { Device, Scene } from "./device";

const DELAY = 0.24; // s
const LAG = 0.15; // s
const NOISE = 0.1;
const SLOWING = 0.8; // s
const LOOK_BACK = 1; // s
const HELD = 1.5; // s
const TURN = 0.8; // rad
const LOST = 0.05; // m
const STOPS = 0.6; // of the circle's radius
const STARTS_AGAIN = 0.9;
const GIVES_UP = 60; // s

export class Robot implements Device {
  readonly kind = "robot";
  private readonly random: Random;
  private readonly deflection: Float64Array;
  private seen: Float64Array[] = [];
  private stopped = false;
  private detours = 0;
  private side = 1;
  private detourUntil = -1;
  private calmUntil = 0;
  /** Wants to give the trial up. */
  tired = false;

  /**
   * @param limit of the stick, m/cycle
   * @param rate cycles per second
   * @param radius of the target circle, m
   */
  constructor(
    private readonly seed: number,
    axes: number,
    private readonly limit: number,
    private readonly rate: number,
    private readonly radius: number,
  ) {
    this.random = new Random(seed);
    this.deflection = new Float64Array(axes);
  }

  begin(): void {
    this.seen = [];
    this.deflection.fill(0);
    this.stopped = this.tired = false;
    this.detours = 0;
    this.side = this.random.uniform() < 0.5 ? -1 : 1;
    this.detourUntil = -1;
    this.calmUntil = 0;
  }

  see({ cycle, x, target }: Scene): void {
    this.seen.push(Float64Array.from(x));
    this.tired = cycle >= GIVES_UP * this.rate;
    const then = Math.round(cycle - DELAY * this.rate);
    if (then < 0) return;
    const now = this.seen[then];
    const before = this.seen[Math.max(0, Math.round(then - LOOK_BACK * this.rate))];
    const toGo = now.map((v, i) => target[i] - v);
    const distance = norm(toGo);
    const moved = norm(now.map((v, i) => v - before[i]));
    this.reconsider(cycle, then, moved, distance - norm(before.map((v, i) => target[i] - v)));
    this.stopped = distance < (this.stopped ? STARTS_AGAIN : STOPS) * this.radius;
    const size = this.stopped ? 0 : Math.min(1, distance / Math.max(SLOWING * this.rate, 1) / this.limit);
    const aim = toGo.map((v) => (size * v) / Math.max(distance, 1e-12));
    if (cycle < this.detourUntil) turn(aim, this.side * TURN * this.detours);
    const follow = 1 - Math.exp(-1 / (LAG * this.rate));
    for (let i = 0; i < aim.length; i++) this.deflection[i] += follow * (aim[i] - this.deflection[i]);
    const noise = follow * NOISE * norm(this.deflection);
    for (let i = 0; i < aim.length; i++) this.deflection[i] += noise * this.random.normal();
  }

  read(out: Float64Array): void {
    for (let i = 0; i < out.length; i++) out[i] = Math.max(-1, Math.min(1, this.deflection[i]));
  }

  triggered(): boolean {
    return true;
  }

  about(): Record<string, string | number> {
    return { seed: this.seed };
  }

  private reconsider(cycle: number, then: number, moved: number, lostGround: number): void {
    const watched = then >= LOOK_BACK * this.rate && cycle >= this.calmUntil && !this.stopped;
    if (!watched || (lostGround <= LOST && moved >= 0.1 * LOST)) return;
    this.detours += 1;
    this.side *= -1;
    this.detourUntil = cycle + HELD * this.rate;
    this.calmUntil = this.detourUntil + LOOK_BACK * this.rate;
  }
}

/** To the left by an angle, in the plane of the first two axes. */
function turn(v: Float64Array, angle: number): void {
  const [x, y] = v;
  v[0] = Math.cos(angle) * x - Math.sin(angle) * y;
  v[1] = Math.sin(angle) * x + Math.cos(angle) * y;
}
