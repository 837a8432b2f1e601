/**
 * Arithmetic of the control clock, without a clock. Cycle k is due at `start + k / rate`. A wake-up that comes late does the
 * cycles that are due meanwhile, as many as a person would not notice; the others are missed, so that the arm never leaps.
 */

/** Fraction of a period by which a wake-up may come early. */
const EARLY = 0.25;
/** Delay up to which missed cycles are made up, s. */
const MADE_UP = 0.1;
/** Delay from which a cycle counts as late, s. */
const LATE = 0.01;

export class Schedule {
  private last = -1;
  private readonly most: number;
  /** Number of cycles skipped so far. */
  missed = 0;
  /** Number of late wake-ups. */
  late = 0;
  /** The latest of all, s. */
  worst = 0;

  /** @param start s; @param rate cycles per second */
  constructor(readonly start: number, readonly rate: number) {
    this.most = Math.max(1, Math.floor(MADE_UP * rate));
  }

  /** Return the number of cycles to do at a time, s. */
  wake(now: number): number {
    const slot = Math.floor((now - this.start) * this.rate + EARLY);
    const due = slot - this.last;
    if (due <= 0) return 0;
    const behind = now - this.start - (this.last + 1) / this.rate;
    const cycles = Math.min(due, this.most);
    this.last = slot;
    this.missed += due - cycles;
    if (behind > LATE) this.late += 1;
    this.worst = Math.max(this.worst, behind);
    return cycles;
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
    const usual = sorted[Math.floor(sorted.length / 2)] ?? 0;
    return { frames: sorted.length, slow: sorted.filter((i) => i > 1.5 * usual).length, usual, worst: sorted.at(-1) ?? 0 };
  }
}
