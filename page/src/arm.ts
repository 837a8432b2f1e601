/** The arm: a module that the server prints from the expressions of its own kernels. */

export interface Arm {
  readonly joints: number;
  readonly axes: number;
  readonly laws: number;
  readonly markers: number;
  /** One control cycle: `out` gets the configuration after it and the tool point's velocity at its beginning, m/cycle. */
  cycle(law: number, q: Float64Array, velocity: Float64Array, healthy: Float64Array, out: Float64Array): void;
  /** Task rows of the tool point, m. */
  position(q: Float64Array, out: Float64Array): void;
  /** Base, every joint and tool point in the base frame, m, one after the other. */
  points(q: Float64Array, out: Float64Array): void;
}

export async function loadArm(address: string): Promise<Arm> {
  return (await import(/* @vite-ignore */ address)) as Arm;
}
