/**
 * Arithmetic of the control clock, without a clock. Cycle k is due at `start + k / rate`. A wake-up counts for the cycle it is
 * nearest to; cycles that nobody woke up for are missed, and not made up for: the arm would leap.
 */

export interface Tick {
  /** Seconds after the cycle was due; negative before. */
  late: number;
  /** Cycles left out since the last one. */
  missed: number;
}

export class Schedule {
  private last = -1;
  /** Cycles left out so far. */
  missed = 0;
  /** Cycles done later than a quarter of a period after they were due. */
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
  ) {}

  /** What a wake-up at a time, s, is for; null: nothing, that cycle has been done. */
  wake(now: number): Tick | null {
    const slot = Math.round((now - this.start) * this.rate);
    if (slot <= this.last) return null;
    const missed = slot - this.last - 1;
    const late = now - this.start - slot / this.rate;
    this.last = slot;
    this.missed += missed;
    // A cycle after missed ones is late by them too.
    const behind = late + missed / this.rate;
    if (behind > 0.25 / this.rate) this.late += 1;
    this.worst = Math.max(this.worst, behind);
    return { late, missed };
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
