/** Waiting time before the next try, which grows each time and differs between stations. */

const FIRST = 0.25;
const MOST = 5;

/** @param tries how many have failed; @param chance 0 to 1; @returns s */
export function backoff(tries: number, chance: number): number {
  return Math.min(MOST, FIRST * 2 ** tries) * (0.75 + 0.5 * chance);
}
