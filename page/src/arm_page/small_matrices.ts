/** Numerical methods for small matrices, which are lists of rows, and for motions. */

export type Rows = Float64Array[];

/** A row that is this much shorter than before its projection depends on the rows before it. */
const DEPENDENT_RATIO = 1e-13;
const MAX_SWEEPS = 30;

/** Return the rows of a matrix that is stored row by row, as views. */
export function splitRows(values: Float64Array, rowCount: number): Rows {
  const columns = values.length / rowCount;
  const rows: Rows = [];
  for (let i = 0; i < rowCount; i++) rows.push(values.subarray(i * columns, (i + 1) * columns));
  return rows;
}

export function dotProduct(a: ArrayLike<number>, b: ArrayLike<number>): number {
  let total = 0;
  for (let i = 0; i < a.length; i++) total += a[i] * b[i];
  return total;
}

export const vectorNorm = (a: ArrayLike<number>): number => Math.sqrt(dotProduct(a, a));

/** Return a + scale b, by a loop, which is ten times as fast as `Float64Array.from`. */
export function addScaled(a: ArrayLike<number>, b: ArrayLike<number>, scale: number): Float64Array {
  const sum = new Float64Array(a.length);
  for (let i = 0; i < a.length; i++) sum[i] = a[i] + scale * b[i];
  return sum;
}

/** Return the product of weights (a x b) and rows (b x n). */
export const combineRows = (weights: ArrayLike<number>[], rows: Rows): Rows =>
  weights.map((line) => rows.reduce((total, row, k) => addScaled(total, row, line[k]), new Float64Array(rows[0].length)));

/** Return the norm of each of the columns. */
export function columnNorms(rows: Rows, count: number): Float64Array {
  const squares = new Float64Array(count);
  for (const row of rows) for (let k = 0; k < count; k++) squares[k] += row[k] * row[k];
  return squares.map(Math.sqrt);
}

/**
 * Return orthonormal rows, and the lower triangular factor with `rows = lower basis`; a dependent row has a basis row of zeros.
 * The Gram-Schmidt method, twice for each row, avoids the squared condition number of `J J'`.
 */
export function factorRows(rows: Rows): { basis: Rows; lower: Rows } {
  const basis: Rows = [];
  const lower = rows.map(() => new Float64Array(rows.length));
  rows.forEach((row, i) => {
    let rest: Float64Array = row;
    for (let pass = 0; pass < 2; pass++) {
      for (let k = 0; k < i; k++) {
        const part = dotProduct(basis[k], rest);
        lower[i][k] += part;
        rest = addScaled(rest, basis[k], -part);
      }
    }
    const norm = vectorNorm(rest);
    lower[i][i] = norm > DEPENDENT_RATIO * vectorNorm(row) ? norm : 0;
    basis.push(rest.map((value) => (lower[i][i] > 0 ? value / norm : 0)));
  });
  return { basis, lower };
}

/** Return orthonormal rows of a length that complete other rows of this length to a basis. */
export function findComplement(rows: Rows, length: number): Rows {
  const units = Array.from({ length }, (_, k) => Float64Array.from({ length }, (_unit, j) => Number(j === k)));
  return factorRows([...rows, ...units]).basis.slice(rows.length).filter(vectorNorm);
}

/** Solve `lower' x = b`; the unknowns of dependent rows are 0. */
export function solveTransposed(lower: Rows, b: Float64Array): Float64Array {
  const x = new Float64Array(b.length);
  for (let i = b.length - 1; i >= 0; i--) {
    let rest = b[i];
    for (let k = i + 1; k < b.length; k++) rest -= lower[k][i] * x[k];
    x[i] = lower[i][i] > 0 ? rest / lower[i][i] : 0;
  }
  return x;
}

/** Return a singular value for each row with its left singular vector, largest first, by one-sided Jacobi rotations. */
export function findSingularValues(rows: ArrayLike<number>[]): { value: number; direction: Float64Array }[] {
  const rotated = rows.map((row) => Float64Array.from(row));
  const directions = rows.map((_, i) => Float64Array.from(rows, (_row, k) => (i === k ? 1 : 0)));
  for (let sweep = 0, largestCosine = 1; sweep < MAX_SWEEPS && largestCosine > 1e-16; sweep++) {
    largestCosine = 0;
    for (let i = 0; i < rows.length; i++) {
      for (let k = i + 1; k < rows.length; k++) {
        const product = dotProduct(rotated[i], rotated[k]);
        if (product === 0) continue;
        const [square, otherSquare] = [dotProduct(rotated[i], rotated[i]), dotProduct(rotated[k], rotated[k])];
        largestCosine = Math.max(largestCosine, Math.abs(product) / Math.sqrt(square * otherSquare));
        const slope = (otherSquare - square) / (2 * product);
        const tangent = (slope < 0 ? -1 : 1) / (Math.abs(slope) + Math.sqrt(1 + slope * slope));
        const cosine = 1 / Math.sqrt(1 + tangent * tangent);
        for (const list of [rotated, directions]) {
          const [first, second] = [list[i], list[k]];
          list[i] = first.map((value, j) => cosine * (value - tangent * second[j]));
          list[k] = second.map((value, j) => cosine * (value + tangent * first[j]));
        }
      }
    }
  }
  const values = rotated.map((row, i) => ({ value: vectorNorm(row), direction: directions[i] }));
  return values.sort((first, second) => second.value - first.value);
}

/** Return the state after a step of the classic Runge-Kutta method of order 4. */
export function stepRungeKutta(
  derivative: (state: Float64Array) => Float64Array,
  state: Float64Array,
  step: number,
): Float64Array {
  const first = derivative(state);
  const second = derivative(addScaled(state, first, step / 2));
  const third = derivative(addScaled(state, second, step / 2));
  const fourth = derivative(addScaled(state, third, step));
  return state.map((value, i) => value + (step / 6) * (first[i] + 2 * second[i] + 2 * third[i] + fourth[i]));
}
