/** The control clock, which calls back at a fixed rate, independently of the display. */

import { Schedule } from "./schedule";

export class Clock {
  private readonly worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
  private schedule: Schedule | null = null;

  /** Start the clock with the first cycle immediately; times are seconds since then. */
  start(rate: number, onCycle: (time: number) => void): void {
    this.stop();
    this.worker.onmessage = (): void => {
      const now = performance.now() / 1000;
      // Time zero is the first wake-up, so that the worker's clock and this one need not agree.
      this.schedule ??= new Schedule(now, rate);
      const { start } = this.schedule;
      const cycles = this.schedule.wake(now);
      // The first of several cycles may end the trial, and stop this clock.
      for (let i = 0; i < cycles && this.schedule !== null; i++) onCycle(now - start);
    };
    this.worker.postMessage(rate);
  }

  /** Stop the clock and return its statistics. */
  stop(): Schedule | null {
    const done = this.schedule;
    this.worker.onmessage = null;
    this.worker.postMessage(null);
    this.schedule = null;
    return done;
  }

  /** Seconds since the first cycle. */
  get now(): number {
    return this.schedule === null ? 0 : performance.now() / 1000 - this.schedule.start;
  }
}
