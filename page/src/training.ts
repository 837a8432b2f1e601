/** When a subject has practised enough: `holdfast.teleop.protocol.Training`. */

export interface Criterion {
  at_least: number;
  in_a_row: number;
  limit: number;
  most: number;
}

/** @param cycles completion times in order, in cycles; null for a task that was not completed */
export function trained(criterion: Criterion, cycles: readonly (number | null)[]): boolean {
  const done = cycles.filter((c) => c !== null).length;
  return done >= criterion.at_least && inARow(criterion, cycles) >= criterion.in_a_row;
}

/** Number of last consecutive tasks that were completed within the limit. */
export function inARow(criterion: Criterion, cycles: readonly (number | null)[]): number {
  return cycles.length - 1 - cycles.findLastIndex((c) => c === null || c > criterion.limit);
}
