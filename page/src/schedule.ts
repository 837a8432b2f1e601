/**
 * Arithmetic of the control clock, without a clock. Cycle k is due at `start + k / rate`. A wake-up that comes late does the
 * cycles that are due meanwhile, as many as a person would not notice; the others are missed, so that the arm never leaps.
 */

export interface Tick {
  /** Cycles to be done now. */
  cycles: number;
  /** Cycles left out before them. */
  missed: number;
}

/** A wake-up may come so much before its time, of a period. */
const EARLY = 0.25;
/** Cycles of so many seconds are made up for. */
const MADE_UP = 0.1;
/** A cycle is late from so many seconds on. */
const LATE = 0.01;

export class Schedule {
  private last = -1;
  private readonly most: number;
  /** Cycles left out so far. */
  missed = 0;
  /** Wake-ups that came late. */
  late = 0;
  /** The latest of all, s. */
  worst = 0;

  /**
   * @param start s
   * @param rate cycles per second
   */
  constructor(
    readonly start: number,
    readonly rate: number,
  ) {
    this.most = Math.max(1, Math.floor(MADE_UP * rate));
  }

  /** What is to be done at a time, s; null: nothing yet. */
  wake(now: number): Tick | null {
    const slot = Math.floor((now - this.start) * this.rate + EARLY);
    const due = slot - this.last;
    if (due <= 0) return null;
    const behind = now - this.start - (this.last + 1) / this.rate;
    const cycles = Math.min(due, this.most);
    this.last = slot;
    this.missed += due - cycles;
    if (behind > LATE) this.late += 1;
    this.worst = Math.max(this.worst, behind);
    return { cycles, missed: due - cycles };
  }
}

/** Frames of the display: how many there were, and how many took more than one and a half times the usual. */
export class Frames {
  private readonly intervals: number[] = [];
  private last: number | null = null;

  /** A frame is drawn at a time, s. */
  at(now: number): void {
    if (this.last !== null && this.intervals.length < 100_000) this.intervals.push(now - this.last);
    this.last = now;
  }

  summary(): { frames: number; slow: number; usual: number; worst: number } {
    const sorted = [...this.intervals].sort((a, b) => a - b);
    const usual = sorted.length ? sorted[Math.floor(sorted.length / 2)] : 0;
    return {
      frames: sorted.length,
      slow: sorted.filter((i) => i > 1.5 * usual).length,
      usual,
      worst: sorted.length ? sorted[sorted.length - 1] : 0,
    };
  }
}
